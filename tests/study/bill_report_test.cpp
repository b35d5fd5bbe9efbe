#include "study/bill_report.h"

#include <gtest/gtest.h>

using namespace sateen;

TEST(Bill, SaysInWordsWhereAnEffectSavesTimeOrCalmsThePicture) {
  Bill bill;
  BillItem item;
  item.effect = Effect::self_shadowing;
  item.time_share = -0.031;
  item.variance_share = -0.25;
  bill.items.push_back(item);
  item.time_share = 0.4;
  item.variance_share = 0.1;
  bill.items.push_back(item);
  item.time_share = -0.0001;  // nothing, by the clock
  item.variance_share.reset();
  bill.items.push_back(item);
  const auto rows = bill_table(bill).rows;
  EXPECT_EQ(rows[0][1], "1.03 times without it");
  EXPECT_EQ(rows[0][2], "1.25 times without it");
  EXPECT_EQ(rows[1][1], "40.0 %");
  EXPECT_EQ(rows[1][2], "10.0 %");
  EXPECT_EQ(rows[2][1], "0.0 %");
  EXPECT_EQ(rows[2][2], "-");
}
