/* Prony terms from a CSV file: the columns tau_s and G_Pa, in any order.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>
#include <string.h>

#include "base/report.h"
#include "files/file_text.h"
#include "files/number.h"
#include "files/prony_terms.h"

static const char *const names[2] = {"tau_s", "G_Pa"};

struct reading {
    const char *file;
    size_t line;  /* the current one, from 1 */
    int header;   /* whether it was read */
    int of[2];    /* which name a column has */
    char *cell[3]; /* of the current row: one more than there may be, to name it */
    size_t cells;
    struct prony_terms *terms;
    restitute_error *error;
};

static int refuse(const struct reading *reading, const char *why)
{
    return rst_report(reading->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: %s", reading->file, reading->line, why);
}

/* Splits a line at its commas, in place. Blanks around a cell are dropped, and the quotes around a
 * quoted one; a quote elsewhere is refused. */
static int split(struct reading *reading, char *at)
{
    static const char blanks[] = " \t\r";
    for (reading->cells = 0;; at++) {
        char *begin = at + strspn(at, blanks), *end;
        if (*begin == '"') {
            begin++;
            end = begin + strcspn(begin, "\"");
            if (*end == '\0') return refuse(reading, "a quote is never closed");
            at = end + 1 + strspn(end + 1, blanks);
        } else {
            at = end = begin + strcspn(begin, ",");
            while (end > begin && strchr(blanks, end[-1]))
                end--;
        }
        const char separator = *at;
        *end = '\0';
        if ((separator != ',' && separator != '\0') || strchr(begin, '"'))
            return refuse(reading, "a quote that does not enclose a cell");
        if (reading->cells < 3) reading->cell[reading->cells] = begin;
        reading->cells++;
        if (separator == '\0') return RESTITUTE_OK;
    }
}

/* Exactly the two columns. */
static int read_header(struct reading *reading)
{
    int found[2] = {0, 0};
    for (size_t i = 0; i < reading->cells && i < 3; i++) {
        const char *name = reading->cell[i];
        const int which = strcmp(name, names[0]) == 0 ? 0 : strcmp(name, names[1]) == 0 ? 1 : -1;
        if (strpbrk(name, ";\t"))
            return rst_report(reading->error, RESTITUTE_ERROR_FORMAT,
                              "%s: the column names are separated by %s: must be by commas, tau_s,G_Pa", reading->file,
                              strchr(name, ';') ? "semicolons" : "tabs");
        if (which < 0)
            return rst_report(reading->error, RESTITUTE_ERROR_FORMAT,
                              "%s: unknown column %.64s; a Prony table has tau_s and G_Pa", reading->file, name);
        if (found[which]++)
            return rst_report(reading->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: column %s appears twice",
                              reading->file, reading->line, name);
        reading->of[i] = which; /* a third column was refused as unknown or repeated */
    }
    for (int k = 0; k < 2; k++)
        if (!found[k])
            return rst_report(reading->error, RESTITUTE_ERROR_FORMAT,
                              "%s: no column %s; a Prony table has tau_s and G_Pa", reading->file, names[k]);
    reading->header = 1;
    return RESTITUTE_OK;
}

static int read_row(struct reading *reading)
{
    struct prony_terms *terms = reading->terms;
    if (reading->cells != 2)
        return rst_report(reading->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: %zu cells, but the header has 2 columns",
                          reading->file, reading->line, reading->cells);
    for (int i = 0; i < 2; i++) {
        double *value = reading->of[i] ? terms->modulus : terms->relaxation_time;
        const int status = rst_number_read(reading->cell[i], &value[terms->count]);
        if (status != RESTITUTE_OK)
            return rst_report(reading->error, status, "%s line %zu: %s = \"%.64s\": must be a finite number > 0",
                              reading->file, reading->line, names[reading->of[i]], reading->cell[i]);
    }
    terms->line[terms->count++] = reading->line;
    return RESTITUTE_OK;
}

/* Empty lines and lines that begin with # are skipped. */
static int read_lines(struct reading *reading, char *at)
{
    int status = RESTITUTE_OK;
    if (strncmp(at, "\xEF\xBB\xBF", 3) == 0) at += 3; /* the byte-order mark that some spreadsheets write */
    while (status == RESTITUTE_OK && *at) {
        char *line = at;
        at += strcspn(at, "\n");
        if (*at) *at++ = '\0';
        reading->line++;
        if (*line == '#' || line[strspn(line, " \t\r")] == '\0') continue;
        status = split(reading, line);
        if (status == RESTITUTE_OK) status = reading->header ? read_row(reading) : read_header(reading);
    }
    return status;
}

static int terms_from_text(const struct file_text *text, const char *file, struct prony_terms *terms,
                           restitute_error *error)
{
    struct reading reading = {.file = file, .terms = terms, .error = error};
    if (memchr(text->bytes, '\0', text->length))
        return rst_report(error, RESTITUTE_ERROR_FORMAT, "%s: a NUL byte; not a text file", file);
    /* A row has at least four bytes, "1,1" and its end. */
    int status = rst_prony_terms_allocate(text->length / 4 + 1, terms, error);
    if (status != RESTITUTE_OK) return status;
    terms->count = 0;
    status = read_lines(&reading, text->bytes);
    if (status == RESTITUTE_OK && !reading.header)
        status = rst_report(error, RESTITUTE_ERROR_FORMAT,
                            "%s: is empty; it must begin with a row of column names", file);
    if (status == RESTITUTE_OK && terms->count == 0)
        status = rst_report(error, RESTITUTE_ERROR_FORMAT, "%s: has column names but no rows", file);
    if (status == RESTITUTE_OK) status = rst_prony_terms_check(terms, file, names[0], names[1], error);
    if (status != RESTITUTE_OK) rst_prony_terms_release(terms);
    return status;
}

int rst_prony_terms_read_csv(const char *path, struct prony_terms *terms, uint64_t *fingerprint, restitute_error *error)
{
    struct file_text text;
    int status = rst_file_text_read(path, &text, error);
    if (status != RESTITUTE_OK) return status;
    *fingerprint = rst_file_text_fingerprint(&text);
    status = terms_from_text(&text, rst_file_name_for_message(path), terms, error);
    free(text.bytes);
    return status;
}
