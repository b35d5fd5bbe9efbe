#pragma once
#include "render/bill.h"
#include "report/page.h"

namespace sateen {

/// One row an effect.
Table bill_table(const Bill& bill);

/// The table and, for every effect, a slider between the picture with it, without it, and the difference.
void add_bill(Page& page, const Bill& bill);

}  // namespace sateen
