// The header in C++.
// SPDX-License-Identifier: BSD-3-Clause
#include <restitute/restitute.h>

int main()
{
    double ez = 0, ex = 0;
    const int status = restitute_pair(7.0 / 6, 2.0, 1.0, 1.0, &ez, &ex, nullptr);
    return status == RESTITUTE_OK && ez > 0 ? 0 : 1;
}
