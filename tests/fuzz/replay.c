/* Runs a target on files, without libFuzzer:  replay FILE...
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"

int main(int count, char **path)
{
    enum { most = 1 << 16 };
    static uint8_t data[most];
    for (int i = 1; i < count; i++) {
        FILE *file = fopen(path[i], "rb");
        REQUIRE(file, "%s cannot be read", path[i]);
        const size_t size = fread(data, 1, most, file);
        fclose(file);
        uint8_t *exact = malloc(size + 1); /* sanitizers see what reads beyond */
        REQUIRE(exact && size < most, "%s: %zu bytes", path[i], size);
        memcpy(exact, data, size);
        printf("%s\n", path[i]);
        fflush(stdout);
        LLVMFuzzerTestOneInput(exact, size);
        free(exact);
    }
    printf("%d inputs\n", count - 1);
    return count > 1 ? 0 : 1;
}
