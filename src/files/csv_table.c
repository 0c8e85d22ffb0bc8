/* CSV tables: libcsv splits the text into cells; this file keeps them and checks that they form a
 * table.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "files/csv_table.h"

#include <csv.h>
#include <stdlib.h>
#include <string.h>

#include "base/report.h"
#include "files/file_text.h"

/* A growing array of bytes or of positions. */
struct buffer {
    void *items;
    size_t count, capacity;
};

struct rst_csv {
    size_t columns, rows;
    struct buffer text;  /* char: all cells, each with its NUL */
    struct buffer cells; /* size_t: where in text each cell begins, header first, row by row */
    struct buffer lines; /* size_t: the line on which each row ends, header first */
    uint64_t fingerprint;
};

/* State of a reading: libcsv calls back for every cell and for every end of a row. */
struct reading {
    struct rst_csv *csv;
    const char *name;
    size_t line;      /* current line of the file */
    size_t row_start; /* cells before the current row */
    int status;
    restitute_error *error;
};

static void *buffer_append(struct buffer *buffer, size_t count, size_t size)
{
    if (buffer->capacity - buffer->count < count) {
        const size_t capacity = 2 * buffer->capacity + count + 64;
        void *larger = realloc(buffer->items, capacity * size);
        if (!larger) return NULL;
        buffer->items = larger;
        buffer->capacity = capacity;
    }
    void *place = (char *)buffer->items + buffer->count * size;
    buffer->count += count;
    return place;
}

static int no_memory(struct reading *reading)
{
    return reading->status = rst_report(reading->error, RESTITUTE_ERROR_MEMORY, "%s line %zu: out of memory",
                                        reading->name, reading->line);
}

static void on_cell(void *bytes, size_t length, void *data)
{
    struct reading *reading = data;
    struct rst_csv *csv = reading->csv;
    if (reading->status != RESTITUTE_OK) return;
    if (memchr(bytes, '\0', length)) {
        reading->status = rst_report(reading->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: a NUL byte; not a text file",
                                     reading->name, reading->line);
        return;
    }
    const size_t start = csv->text.count;
    size_t *cell = buffer_append(&csv->cells, 1, sizeof *cell);
    char *text = buffer_append(&csv->text, length + 1, 1);
    if (!cell || !text) {
        no_memory(reading);
        return;
    }
    *cell = start;
    memcpy(text, bytes, length);
    text[length] = '\0';
}

static const char *cell_text(const struct rst_csv *csv, size_t cell)
{
    return (const char *)csv->text.items + ((const size_t *)csv->cells.items)[cell];
}

/* A column by its name, for sorting; like names stay in the order of the columns. */
struct named_column {
    const char *name;
    size_t column;
};

static int by_name(const void *left, const void *right)
{
    const struct named_column *a = left, *b = right;
    const int order = strcmp(a->name, b->name);
    return order ? order : (a->column > b->column) - (a->column < b->column);
}

/* The first column whose name one before it has; `columns` if there is none. */
static size_t first_repeated(struct named_column *names, size_t columns)
{
    size_t first = columns;
    qsort(names, columns, sizeof *names, by_name);
    for (size_t i = 1; i < columns; i++)
        if (names[i].column < first && strcmp(names[i].name, names[i - 1].name) == 0) first = names[i].column;
    return first;
}

/* The header: every column has a name, and none has another's. */
static int check_names(struct reading *reading)
{
    const struct rst_csv *csv = reading->csv;
    struct named_column *names = malloc(csv->columns * sizeof *names);
    if (!names) return no_memory(reading);
    int status = RESTITUTE_OK;
    for (size_t i = 0; i < csv->columns && status == RESTITUTE_OK; i++) {
        names[i] = (struct named_column){cell_text(csv, i), i};
        if (!*names[i].name)
            status = rst_report(reading->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: column %zu has no name",
                                reading->name, reading->line, i + 1);
    }
    const size_t repeated = status == RESTITUTE_OK ? first_repeated(names, csv->columns) : csv->columns;
    if (repeated < csv->columns)
        status = rst_report(reading->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: column %.64s appears twice",
                            reading->name, reading->line, cell_text(csv, repeated));
    free(names);
    return status;
}

static void on_row_end(int terminator, void *data)
{
    (void)terminator;
    struct reading *reading = data;
    struct rst_csv *csv = reading->csv;
    if (reading->status != RESTITUTE_OK) return;
    size_t *line = buffer_append(&csv->lines, 1, sizeof *line);
    if (!line) {
        no_memory(reading);
        return;
    }
    *line = reading->line;
    const size_t count = csv->cells.count - reading->row_start;
    reading->row_start = csv->cells.count;
    if (csv->columns == 0) {
        csv->columns = count;
        reading->status = check_names(reading);
    } else if (count != csv->columns) {
        reading->status =
            rst_report(reading->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: %zu cells, but the header has %zu columns",
                       reading->name, reading->line, count, csv->columns);
    } else {
        csv->rows++;
    }
}

/* The error of the parser, unless a cell or a row was refused before. */
static void parser_stopped(struct reading *reading, struct csv_parser *parser)
{
    if (reading->status != RESTITUTE_OK) return;
    if (csv_error(parser) == CSV_ENOMEM)
        no_memory(reading);
    else
        reading->status = rst_report(reading->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: %s", reading->name,
                                     reading->line, csv_strerror(csv_error(parser)));
}

/* Feed the text line by line: libcsv has no comments and does not count lines. A # inside quotes is
 * no comment. */
static void feed_lines(struct csv_parser *parser, struct reading *reading, const struct file_text *text)
{
    const char *at = text->bytes, *end = text->bytes + text->length;
    int quoted = 0;
    if (text->length >= 3 && memcmp(at, "\xEF\xBB\xBF", 3) == 0) /* the byte-order mark that some spreadsheets write */
        at += 3;
    while (at < end && reading->status == RESTITUTE_OK) {
        const char *newline = memchr(at, '\n', (size_t)(end - at));
        const size_t length = newline ? (size_t)(newline - at) + 1 : (size_t)(end - at);
        reading->line++;
        if (quoted || *at != '#') {
            if (csv_parse(parser, at, length, on_cell, on_row_end, reading) != length) parser_stopped(reading, parser);
            for (size_t i = 0; i < length; i++)
                quoted ^= at[i] == '"';
        }
        at += length;
    }
}

static int parse_table(struct reading *reading, const struct file_text *text)
{
    struct csv_parser parser;
    if (csv_init(&parser, CSV_STRICT | CSV_STRICT_FINI) != 0) return no_memory(reading);
    csv_set_blk_size(&parser, 128 + text->length / 16); /* a long cell must not grow by 128 bytes again and again */
    feed_lines(&parser, reading, text);
    if (csv_fini(&parser, on_cell, on_row_end, reading) != 0 && reading->status == RESTITUTE_OK)
        reading->status = rst_report(reading->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: a quote is never closed",
                                     reading->name, reading->line);
    csv_free(&parser);
    if (reading->status == RESTITUTE_OK && reading->csv->columns == 0)
        reading->status = rst_report(reading->error, RESTITUTE_ERROR_FORMAT,
                                     "%s: is empty; it must begin with a row of "
                                     "column names",
                                     reading->name);
    return reading->status;
}

int rst_csv_read(const char *path, uint64_t most, struct rst_csv **csv, restitute_error *error)
{
    struct file_text text;
    int status = rst_file_text_read(path, most, &text, error);
    if (status != RESTITUTE_OK) return status;
    struct rst_csv *table = calloc(1, sizeof *table);
    struct reading reading = {table, rst_file_name_for_message(path), 0, 0, RESTITUTE_OK, error};
    if (!table)
        status = no_memory(&reading);
    else
        status = parse_table(&reading, &text);
    if (status == RESTITUTE_OK) {
        table->fingerprint = rst_file_text_fingerprint(&text, FILE_FINGERPRINT_START);
        *csv = table;
        rst_done(error);
    } else {
        rst_csv_destroy(table);
    }
    free(text.bytes);
    return status;
}

void rst_csv_destroy(struct rst_csv *csv)
{
    if (!csv) return;
    free(csv->text.items);
    free(csv->cells.items);
    free(csv->lines.items);
    free(csv);
}

size_t rst_csv_rows(const struct rst_csv *csv)
{
    return csv->rows;
}

size_t rst_csv_columns(const struct rst_csv *csv)
{
    return csv->columns;
}

const char *rst_csv_name(const struct rst_csv *csv, size_t column)
{
    return cell_text(csv, column);
}

const char *rst_csv_cell(const struct rst_csv *csv, size_t row, size_t column)
{
    return cell_text(csv, (row + 1) * csv->columns + column);
}

size_t rst_csv_line(const struct rst_csv *csv, size_t row)
{
    return ((const size_t *)csv->lines.items)[row + 1];
}

uint64_t rst_csv_fingerprint(const struct rst_csv *csv)
{
    return csv->fingerprint;
}
