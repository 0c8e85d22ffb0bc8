/* Runs a target without libFuzzer:  replay COUNT SEED [FIRST [FILE...]]
 * on random inputs FIRST to FIRST + COUNT - 1 of a seed, then on files.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L
#include "../benchmark/extremes.h"
#include "../support/bytes.h"
#include "fuzz.h"

enum { most = 1 << 16, random_size = 4096 };

/* A copy: sanitizers see what reads beyond. */
static void run(const uint8_t *data, size_t size)
{
    uint8_t *exact = malloc(size + 1);
    CHECK(exact, "%zu bytes", size);
    memcpy(exact, data, size);
    alarm(60);
    LLVMFuzzerTestOneInput(exact, size);
    free(exact);
}

int main(int count, char **word)
{
    static uint8_t data[most];
    CHECK(count > 3, "usage: %s COUNT SEED FIRST [FILE...]", word[0]);
    const long inputs = strtol(word[1], NULL, 10), first = strtol(word[3], NULL, 10);
    watch_signals();
    for (current = first; current < first + inputs; current++) {
        uint64_t random = random_of(strtoull(word[2], NULL, 10), current);
        const int most_byte = current % 8 ? 200 : 256; /* number() has odd values from 200 on */
        for (int i = 0; i < random_size; i++)
            data[i] = (uint8_t)random_below(&random, most_byte);
        run(data, random_size);
    }
    for (int i = 4; i < count; i++) {
        printf("%s\n", word[i]);
        fflush(stdout);
        run(data, read_bytes(word[i], data, most));
    }
    printf("%ld random inputs, %d files\n", inputs, count - 4);
    return 0;
}
