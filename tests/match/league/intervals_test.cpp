// SPDX-License-Identifier: Apache-2.0
// Against tables of Student's t and published figures of Wilson's interval.
#include "sil/match/league/intervals.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

namespace striker::sil {
namespace {

TEST(StudentT, IsThatOfTables) {
  for (const auto& [degrees, t] : {std::pair{1, 12.7062}, std::pair{5, 2.5706}, std::pair{10, 2.2281},
                                   std::pair{11, 2.2010}, std::pair{15, 2.1314}, std::pair{19, 2.0930},
                                   std::pair{49, 2.0096}, std::pair{99, 1.9842}, std::pair{10'000, 1.9602}}) {
    EXPECT_NEAR(student_t(degrees), t, 5e-4) << degrees;
  }
}

TEST(Mean, HasAnIntervalFromTwoValuesOn) {
  EXPECT_FALSE(mean_of(std::vector<double>{}).half_width);
  const Mean one = mean_of(std::vector{3.0});
  EXPECT_EQ(one.value, 3.0);
  EXPECT_FALSE(one.half_width);
  const Mean three = mean_of(std::vector{1.0, 2.0, 6.0});  // s is sqrt(7)
  EXPECT_NEAR(three.value, 3.0, 1e-12);
  ASSERT_TRUE(three.half_width);
  EXPECT_NEAR(*three.half_width, 4.3027 * 1.5275252, 1e-4);
}

TEST(Share, IsWilsons) {
  EXPECT_EQ(share_of(0, 0).low, 0.0);
  EXPECT_EQ(share_of(0, 0).high, 1.0);
  const Share half = share_of(50, 100);
  EXPECT_EQ(half.value, 0.5);
  EXPECT_NEAR(half.low, 0.4038, 5e-5);
  EXPECT_NEAR(half.high, 0.5962, 5e-5);
  const Share all = share_of(10, 10);
  EXPECT_NEAR(all.low, 0.7225, 5e-5);
  EXPECT_EQ(all.high, 1.0);
  EXPECT_NEAR(share_of(0, 10).high, 0.2775, 5e-5);
  EXPECT_EQ(share_of(0, 10).low, 0.0);
}

}  // namespace
}  // namespace striker::sil
