// Judges the reads of a device that has to answer each question.
#pragma once

#include "drivers/axis.h"
#include "drivers/common/read_score.h"

namespace tactus::drivers {

// A read with a believable answer is good, whatever else came in it. Only an answer that nobody
// asked for makes it bad all the same.
class ReadJudge {
 public:
  // Begins a read, in which nothing has come yet.
  void begin() { read_ = {}; }
  // Notes a believable answer.
  void believe() { read_.is_fresh = true; }
  // Notes an answer that is rejected for that reason.
  void doubt(const Trouble& reason) { read_.doubt = reason; }
  // Notes an answer that nobody asked for.
  void doubt_unasked(const Trouble& reason) {
    read_.is_unasked = true;
    doubt(reason);
  }
  // Ends a read in which an answer was due. Returns true if the device is at fault.
  bool end_in_fault() {
    if (read_.is_fresh && !read_.is_unasked) {
      score_.good();
      return false;
    }
    return score_.bad();
  }

  // Returns true if a believable answer came in this read.
  [[nodiscard]] bool is_fresh() const { return read_.is_fresh; }
  // Returns the reason why the last answer was rejected, or an empty Trouble.
  [[nodiscard]] const Trouble& doubt() const { return read_.doubt; }

 private:
  struct Read {
    bool is_fresh = false;
    bool is_unasked = false;
    Trouble doubt;
  };

  Read read_;
  ReadScore score_;
};

}  // namespace tactus::drivers
