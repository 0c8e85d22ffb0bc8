/* Prony series in CSV files.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "materials.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bytes choice = {data, 0};
    write_bytes("fuzz.csv", data, size);
    check_file("fuzz.csv", &choice);
    return 0;
}
