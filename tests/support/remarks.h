/* Messages of many calls, counted: those that differ in their numbers alone are one.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_REMARKS_H
#define TEST_REMARKS_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_remarks = 6 };

struct remark {
    char form[256], text[256]; /* without its numbers; the first one of this form */
    char *example;             /* what gave it; freed by free_remarks */
    int status;
    long count;
};

/* Numbers become #. */
static inline void strip_numbers(const char *text, char *form, size_t size)
{
    size_t length = 0;
    while (*text && length < size - 1) {
        const size_t digits = strspn(text, "0123456789");
        form[length++] = digits ? '#' : *text;
        text += digits ? strspn(text, "0123456789.e+-") : 1;
    }
    form[length] = '\0';
}

/* The place of a message, its count raised; the last place takes all others. Its example is still
 * NULL if it is new. */
static inline struct remark *add_remark(struct remark remarks[most_remarks], int status, const char *text)
{
    char form[sizeof remarks[0].form];
    int k = 0;
    strip_numbers(text, form, sizeof form);
    while (k < most_remarks - 1 && remarks[k].count > 0 && strcmp(remarks[k].form, form) != 0)
        k++;
    if (remarks[k].count++ == 0) {
        remarks[k].status = status;
        memcpy(remarks[k].form, form, sizeof form);
        snprintf(remarks[k].text, sizeof remarks[k].text, "%s", text);
    }
    return &remarks[k];
}

static inline void free_remarks(struct remark remarks[most_remarks])
{
    for (int k = 0; k < most_remarks; k++)
        free(remarks[k].example);
}

#endif
