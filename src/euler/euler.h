/* The method `euler`.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_EULER_H
#define RST_EULER_H

#include "base/method.h"

extern const struct restitute_method rst_method_euler;

#endif
