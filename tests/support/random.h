/* The seeded random numbers of `restitute bench`, for tests.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../../src/bench/random.h"
