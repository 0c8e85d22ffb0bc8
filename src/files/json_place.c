/* Walks a JSON text that a parser has already accepted, counting lines and depth.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "files/json_place.h"

#include <string.h>

/* One step of the walk: the next brace, bracket, comma or string, with where it stands. */
struct walk {
    const char *at;
    size_t line, depth;
    const char *string; /* begin of the string just passed, behind its quote; NULL if the step was no string */
    size_t length;
};

/* Step on; returns the character passed ('"' for a string), 0 at the end. */
static char next_token(struct walk *walk)
{
    for (; *walk->at; walk->at++) {
        const char c = *walk->at;
        if (c == '\n') walk->line++;
        if (c == '"') {
            walk->string = walk->at + 1;
            for (walk->at++; *walk->at && *walk->at != '"'; walk->at++)
                if (*walk->at == '\\' && walk->at[1]) walk->at++;
            walk->length = (size_t)(walk->at - walk->string);
            walk->at += *walk->at == '"';
            return c;
        }
        if (strchr("{}[],:", c)) {
            walk->string = NULL;
            walk->depth += c == '{' || c == '[';
            walk->depth -= c == '}' || c == ']';
            walk->at++;
            return c;
        }
    }
    return 0;
}

/* Walk to the key of the outermost object; it is a key and not a value if a colon follows. */
static int walk_to_key(struct walk *walk, const char *key)
{
    for (char token = next_token(walk); token; token = next_token(walk)) {
        if (token != '"' || walk->depth != 1 || walk->length != strlen(key) ||
            memcmp(walk->string, key, walk->length) != 0)
            continue;
        const size_t line = walk->line;
        if (next_token(walk) == ':') {
            walk->line = line;
            return 1;
        }
    }
    return 0;
}

size_t rst_json_line_of_key(const char *text, const char *key)
{
    struct walk walk = {text, 1, 0, NULL, 0};
    return walk_to_key(&walk, key) ? walk.line : 0;
}

/* Step over white space, counting lines. */
static void skip_space(struct walk *walk)
{
    for (; *walk->at == ' ' || *walk->at == '\t' || *walk->at == '\r' || *walk->at == '\n'; walk->at++)
        if (*walk->at == '\n') walk->line++;
}

void rst_json_lines_of_items(const char *text, const char *key, size_t *line, size_t count)
{
    struct walk walk = {text, 1, 0, NULL, 0};
    size_t found = 0;
    walk_to_key(&walk, key);
    for (char token = next_token(&walk); token && walk.depth > 1 && found < count; token = next_token(&walk))
        if (walk.depth == 2 && (token == '[' || token == ',')) {
            skip_space(&walk);
            line[found++] = walk.line;
        }
    while (found < count)
        line[found++] = walk.line;
}
