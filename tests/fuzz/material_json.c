/* Material files: a line whose bytes choose the struct and the temperature, JSON, and from a byte
 * 0xFF on the file that "prony_csv" may name.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "materials.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t *end = size ? memchr(data, '\n', size) : NULL;
    if (!end) return 0;
    struct bytes choice = {data, (size_t)(end - data)};
    data = end + 1;
    size -= choice.left + 1;
    const uint8_t *csv = size ? memchr(data, 0xff, size) : NULL;
    const size_t json = csv ? (size_t)(csv - data) : size;
    if (csv) write_bytes("fuzz.csv", csv + 1, size - json - 1);
    write_bytes("fuzz.json", data, json);
    check_file("fuzz.json", &choice);
    return 0;
}
