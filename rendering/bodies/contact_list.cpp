#include "rendering/bodies/contact_list.h"

#include <algorithm>

namespace tactus::rendering {

void ContactList::clear() {
  count_ = 0;
  left_out_ = false;
}

void ContactList::begin_tick() {
  std::ranges::transform(all(), before_.begin(),
                         [](const BodyContact& contact) { return past_of(contact); });
  before_count_ = count_;
  clear();
}

void ContactList::take_kept(BodySleep& sleep) {
  before_count_ += sleep.take_contacts(std::span(before_).subspan(before_count_));
}

void ContactList::add(std::uint16_t a, std::uint16_t b, const ContactSurface& surface,
                      const Manifold& manifold, std::span<const SolverBody> bodies) {
  if (count_ == kMaxBodyContacts) {
    left_out_ = true;
    return;
  }
  BodyContact& contact = contacts_[count_++];
  contact.a = a;
  contact.b = b;
  contact.surface = surface;
  begin_contact(manifold, bodies, past(a, b, manifold.normal_W), contact);
}

const PastContact* ContactList::past(std::uint16_t a, std::uint16_t b, const Vec3& normal_W) const {
  // A contact goes on while its normal turns by less than the arccosine of this in a tick.
  constexpr double kSameContact = 0.5;
  const PastContact* found = nullptr;
  double likeness = kSameContact;
  for (const PastContact& old : std::span(before_).first(before_count_)) {
    if (old.a == a && old.b == b && old.axes_W[0].dot(normal_W) > likeness) {
      found = &old;
      likeness = old.axes_W[0].dot(normal_W);
    }
  }
  return found;
}

}  // namespace tactus::rendering
