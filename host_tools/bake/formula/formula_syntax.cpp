#include "host_tools/bake/formula/formula_syntax.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using Kind = FormulaNode::Kind;

// Limits that keep the recursion within the stack.
constexpr std::size_t kLongestText = 20'000;
constexpr std::size_t kDeepest = 100;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// A recursive-descent parser, one function for each level of precedence: sums, products, signs,
// powers, atoms. Powers bind tighter than signs and associate to the right: -x^2 is -(x^2), and
// 2^3^2 is 2^9. Coordinates side by side are multiplied and bind tighter than a division: 1/xy^2 is
// 1/(x*y^2).
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  FormulaNode read() {
    if (text_.size() > kLongestText) {
      fail_formula(
          text_, kLongestText,
          fmt::format("{} characters, where {} fit; shorten it", text_.size(), kLongestText));
    }
    FormulaNode root = sum();
    if (place_ < text_.size()) {
      fail_here();
    }
    return root;
  }

 private:
  // Returns the next character that is not blank; 0 at the end.
  char peek() {
    while (place_ < text_.size() &&
           std::string_view(" \t\r\n").find(text_[place_]) != std::string_view::npos) {
      ++place_;
    }
    return place_ < text_.size() ? text_[place_] : '\0';
  }

  // Consumes the next character if it is c.
  bool take(char c) {
    const bool there = peek() == c;
    place_ += there ? 1 : 0;
    return there;
  }

  // Throws the error for a character that fits nowhere.
  [[noreturn]] void fail_here() {
    const char c = peek();
    const auto what = [&]() -> std::string {
      if (place_ >= text_.size()) {
        return "the formula ends too soon; complete it";
      }
      if (static_cast<unsigned char>(c) >= 0x80) {
        return "not a plain letter; write ^2 for a square, * for times, - for minus";
      }
      if (c == '=' || c == '<' || c == '>') {
        return fmt::format(
            "'{}' has no place here; bring all to one side: it is compared with 0, "
            "and inside is below 0",
            c);
      }
      if (is_letter(c) || is_digit(c) || c == '(') {
        return "an operator is missing; write * for times, as in 2*x";
      }
      if (c == ')') {
        return "this parenthesis closes none; remove it or open one";
      }
      if (c == ',') {
        return "a comma stands only between a function's arguments; decimals have a point";
      }
      return fmt::format("'{}' is not expected here; put a number, a name or ( before it", c);
    };
    fail_formula(text_, place_, what());
  }

  // Returns a node with two children.
  FormulaNode binary(Kind kind, std::size_t place, FormulaNode a, FormulaNode b) {
    FormulaNode node{.kind = kind, .place = place};
    node.children.push_back(std::move(a));
    node.children.push_back(std::move(b));
    return node;
  }

  // Counts the nesting, which recursion would otherwise take from the stack.
  void enter() {
    if (++depth_ > kDeepest) {
      fail_formula(text_, place_, fmt::format("nested more than {} deep; simplify it", kDeepest));
    }
  }

  // sum = product { ("+" | "-") product }
  FormulaNode sum() {
    FormulaNode left = product();
    for (char c = peek(); c == '+' || c == '-'; c = peek()) {
      const std::size_t place = place_++;
      left = binary(c == '+' ? Kind::add : Kind::subtract, place, std::move(left), product());
    }
    return left;
  }

  // product = signed { ("*" | "/") signed }
  FormulaNode product() {
    FormulaNode left = signed_factor();
    for (char c = peek(); c == '*' || c == '/'; c = peek()) {
      const std::size_t place = place_++;
      if (c == '*' && peek() == '*') {
        fail_formula(text_, place, "there is no **; write ^ for a power");
      }
      left =
          binary(c == '*' ? Kind::multiply : Kind::divide, place, std::move(left), signed_factor());
    }
    return left;
  }

  // signed = ("-" | "+") signed | power
  FormulaNode signed_factor() {
    enter();
    FormulaNode node;
    const char c = peek();
    if (c == '-') {
      node = {.kind = Kind::negate, .place = place_++};
      node.children.push_back(signed_factor());
    } else if (c == '+') {
      ++place_;
      node = signed_factor();
    } else {
      node = power();
    }
    --depth_;
    return node;
  }

  // power = atom [ "^" signed ] [ power, in a run of coordinates ]
  FormulaNode power() {
    FormulaNode base = atom();
    const std::size_t place = place_;
    if (place_ < run_end_) {
      enter();
      FormulaNode node = binary(Kind::multiply, place, std::move(base), power());
      --depth_;
      return node;
    }
    if (peek() != '^') {
      return base;
    }
    const std::size_t caret = place_++;
    return binary(Kind::power, caret, std::move(base), signed_factor());
  }

  // atom = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
  FormulaNode atom() {
    const char c = peek();
    if (is_digit(c) || c == '.') {
      return number();
    }
    if (is_letter(c)) {
      return name();
    }
    const std::size_t place = place_;
    if (!take('(')) {
      fail_here();
    }
    FormulaNode inner = sum();
    close(place);
    return inner;
  }

  // Consumes the parenthesis that ends what was opened at `opened`.
  void close(std::size_t opened) {
    if (take(')')) {
      return;
    }
    if (place_ < text_.size()) {
      fail_here();
    }
    fail_formula(text_, opened, "this parenthesis is never closed; add )");
  }

  FormulaNode number() {
    FormulaNode node{.kind = Kind::number, .place = place_};
    const char* const end = text_.data() + text_.size();
    const auto result = std::from_chars(text_.data() + place_, end, node.number);
    if (result.ec != std::errc{}) {
      fail_formula(text_, place_,
                   result.ec == std::errc::result_out_of_range
                       ? "this number is beyond what a double holds; write a smaller one"
                       : "this is not a number; write it as 0.5 or 5e-1");
    }
    place_ = static_cast<std::size_t>(result.ptr - text_.data());
    return node;
  }

  FormulaNode name() {
    const std::size_t begin = place_;
    while (place_ < text_.size() && (is_letter(text_[place_]) || is_digit(text_[place_]))) {
      ++place_;
    }
    FormulaNode node{.kind = Kind::name,
                     .name = std::string(text_.substr(begin, place_ - begin)),
                     .place = begin};
    const std::size_t opened = place_;
    if (!take('(')) {
      const bool is_run = node.name.find_first_not_of("xyz") == std::string::npos;
      if (is_run && node.name.size() > 1) {
        run_end_ = opened;
        place_ = begin + 1;
        node.name.resize(1);
      }
      return node;
    }
    node.kind = Kind::call;
    enter();
    if (!take(')')) {
      node.children.push_back(sum());
      while (take(',')) {
        node.children.push_back(sum());
      }
      close(opened);
    }
    --depth_;
    return node;
  }

  std::string_view text_;
  std::size_t place_ = 0;
  // The end of the run of coordinates that is being read: xy is x*y.
  std::size_t run_end_ = 0;
  std::size_t depth_ = 0;
};

}  // namespace

void fail_formula(std::string_view text, std::size_t place, std::string_view what) {
  // Characters of the text that a message shows on either side of the error.
  constexpr std::size_t kContext = 24;
  place = std::min(place, text.size());
  const std::size_t begin = place > kContext ? place - kContext : 0;
  std::string around =
      fmt::format("{}{} >>> {}{}", begin > 0 ? "..." : "", text.substr(begin, place - begin),
                  text.substr(place, kContext), place + kContext < text.size() ? "..." : "");
  std::ranges::replace_if(around, [](unsigned char c) { return c < 0x20; }, ' ');
  throw InputError(fmt::format("formula, column {}: {} (at >>> in: {})", place + 1, what, around));
}

FormulaNode read_formula_syntax(std::string_view text) {
  return Reader(text).read();
}

}  // namespace tactus::host
