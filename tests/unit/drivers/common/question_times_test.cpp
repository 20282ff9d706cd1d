#include "drivers/common/question_times.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

TEST(QuestionTimes, AnswersComeInTheOrderOfTheQuestions) {
  QuestionTimes questions;
  EXPECT_FALSE(questions.has_asked());
  EXPECT_FALSE(questions.answer());
  questions.ask(10);
  questions.ask(20);
  EXPECT_TRUE(questions.has_asked());
  EXPECT_EQ(questions.answer(), 10);
  EXPECT_TRUE(questions.is_open());
  EXPECT_EQ(questions.answer(), 20);
  EXPECT_FALSE(questions.is_open());
  EXPECT_FALSE(questions.answer());
  EXPECT_TRUE(questions.has_asked());
}

TEST(QuestionTimes, TheOldestQuestionsAreForgotten) {
  QuestionTimes questions;
  constexpr hal::TimeNs kAsked = 100;
  for (hal::TimeNs now_ns = 1; now_ns <= kAsked; ++now_ns) {
    questions.ask(now_ns);
  }
  for (hal::TimeNs asked_ns = kAsked - hal::TimeNs{QuestionTimes::kRemembered} + 1;
       asked_ns <= kAsked; ++asked_ns) {
    EXPECT_EQ(questions.answer(), asked_ns);
  }
  EXPECT_FALSE(questions.is_open());
}

}  // namespace
}  // namespace tactus::drivers
