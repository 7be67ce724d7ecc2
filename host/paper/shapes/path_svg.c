/* path_svg.c - the paths of an SVG file: expat parses it, and transforms are applied to
 * chords. */
#include "path.h"

#include "shapes/path_internal.h"

#include <xml_line.h>

#include <expat.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH_MAX = 200, PATHS_LINES_MAX = 20000, ATTRIBUTES_MAX = 1000 };
#define PLACE_MAX 1e6
#define PI 3.14159265358979323846

struct matrix { /* x' = a x + c y + e, y' = b x + d y + f */
    double a, b, c, d, e, f;
};

struct reading {
    XML_Parser parser;
    const char *name;
    double tolerance;
    struct matrix stack[DEPTH_MAX];
    int depth, hidden; /* depth of open elements; depth within an element that is not drawn */
    struct paper_lines *lines;
    enum paper_status status;
};

/* ---- expat's memory: a file of names and attributes takes twenty times as much as it is long
 * ---- */

enum { BLOCK_HEAD = 16, PARSER_BYTES = 1 << 20, PARSER_SHARE = 5 /* times the file */ };

static _Thread_local size_t parser_room; /* of the parse that goes on in this thread */

static void bounded_free(void *block)
{
    if (!block)
        return;
    char *head = (char *)block - BLOCK_HEAD;
    parser_room += *(size_t *)(void *)head;
    free(head);
}

static void *bounded_realloc(void *block, size_t bytes)
{
    char *head = block ? (char *)block - BLOCK_HEAD : NULL;
    const size_t before = head ? *(size_t *)(void *)head : 0;
    if (bytes > before && bytes - before > parser_room)
        return NULL;
    char *made = bytes < SIZE_MAX - BLOCK_HEAD ? realloc(head, BLOCK_HEAD + bytes) : NULL;
    if (!made)
        return NULL;
    parser_room = parser_room + before - bytes;
    *(size_t *)(void *)made = bytes;
    return made + BLOCK_HEAD;
}

static void *bounded_malloc(size_t bytes)
{
    return bounded_realloc(NULL, bytes);
}

static XML_Parser parser_create(size_t count)
{
    static const XML_Memory_Handling_Suite bounded = {bounded_malloc, bounded_realloc,
                                                      bounded_free};
    parser_room = PARSER_BYTES + PARSER_SHARE * count;
    return XML_ParserCreate_MM(NULL, &bounded, NULL);
}

/* ---- the parse ---- */

static void reading_fail(struct reading *r, enum paper_status status, const char *what)
{
    if (r->status != PAPER_OK)
        return;
    char said[400]; /* a copy, because the message may be paper_error() itself */
    snprintf(said, sizeof said, "%s", what);
    r->status = paper_fail(status, "%s:%lu: %s", r->name, xml_line(r->parser), said);
    XML_StopParser(r->parser, XML_FALSE);
}

static struct matrix product(struct matrix m, struct matrix n)
{
    return (struct matrix){m.a * n.a + m.c * n.b,       m.b * n.a + m.d * n.b,
                           m.a * n.c + m.c * n.d,       m.b * n.c + m.d * n.d,
                           m.a * n.e + m.c * n.f + m.e, m.b * n.e + m.d * n.f + m.f};
}

/* Applies one function of a transform attribute; false: unknown, or a wrong number of
 * arguments. */
static bool transform_function(const char *name, size_t length, const double *n, int count,
                               struct matrix *out)
{
    double c = count > 0 ? cos(n[0] * PI / 180) : 0, s = count > 0 ? sin(n[0] * PI / 180) : 0;
    double t = count > 0 ? tan(n[0] * PI / 180) : 0;
    *out = (struct matrix){1, 0, 0, 1, 0, 0};
#define IS(word) (length == sizeof word - 1 && strncmp(name, word, length) == 0)
    if (IS("matrix") && count == 6)
        *out = (struct matrix){n[0], n[1], n[2], n[3], n[4], n[5]};
    else if (IS("translate") && (count == 1 || count == 2))
        *out = (struct matrix){1, 0, 0, 1, n[0], count == 2 ? n[1] : 0};
    else if (IS("scale") && (count == 1 || count == 2))
        *out = (struct matrix){n[0], 0, 0, n[count - 1], 0, 0};
    else if (IS("rotate") && count == 1)
        *out = (struct matrix){c, s, -s, c, 0, 0};
    else if (IS("rotate") && count == 3)
        *out = (struct matrix){
            c, s, -s, c, n[1] - c * n[1] + s * n[2], n[2] - s * n[1] - c * n[2]};
    else if (IS("skewX") && count == 1)
        *out = (struct matrix){1, 0, t, 1, 0, 0};
    else if (IS("skewY") && count == 1)
        *out = (struct matrix){1, t, 0, 1, 0, 0};
    else
        return false;
#undef IS
    return true;
}

static bool transform_parse(const char *text, struct matrix *out)
{
    static const char space[] = " \t\r\n,";
    for (const char *c = text + strspn(text, space); *c; c += strspn(c, space)) {
        const char *name = c;
        size_t length = strcspn(c, " \t\r\n(");
        double numbers[6];
        int count = 0;
        c += length;
        c += strspn(c, " \t\r\n");
        if (*c++ != '(')
            return false;
        for (c += strspn(c, space); *c && *c != ')'; c += strspn(c, space)) {
            char *end;
            if (count == 6 || !strchr("+-.0123456789", *c))
                return false;
            numbers[count] = strtod(c, &end);
            if (end == c || !isfinite(numbers[count]))
                return false;
            count++;
            c = end;
        }
        struct matrix m;
        if (*c++ != ')' || !transform_function(name, length, numbers, count, &m))
            return false;
        *out = product(*out, m);
    }
    return true;
}

static void path_add(struct reading *r, const char *path, const struct matrix *m)
{
    struct paper_lines own;
    /* smaller tolerance if the path is magnified */
    double scale = fmax(hypot(m->a, m->b), hypot(m->c, m->d));
    if (!(scale <= 1e6)) {
        reading_fail(r, PAPER_BAD_ARGUMENT, "a transform magnifies more than 1000000 times");
        return;
    }
    enum paper_status status = paper_path_parse(path, r->tolerance / fmax(scale, 1e-6), &own);
    if (status != PAPER_OK) {
        reading_fail(r, status, paper_error());
        return;
    }
    int count = r->lines->count + own.count;
    struct paper_way *line =
        count <= PATHS_LINES_MAX
            ? realloc(r->lines->line, (size_t)(count ? count : 1) * sizeof *line)
            : NULL;
    if (!line) {
        paper_lines_destroy(&own);
        reading_fail(r, count <= PATHS_LINES_MAX ? PAPER_NO_MEMORY : PAPER_BAD_ARGUMENT,
                     "more than 20000 lines");
        return;
    }
    r->lines->line = line;
    for (int i = 0; i < own.count; i++) {
        struct paper_way *way = &own.line[i];
        for (int j = 0; j < way->points_count; j++) {
            double x = way->points[2 * j], y = way->points[2 * j + 1];
            way->points[2 * j] = m->a * x + m->c * y + m->e;
            way->points[2 * j + 1] = m->b * x + m->d * y + m->f;
            if (!(fabs(way->points[2 * j]) <= PLACE_MAX &&
                  fabs(way->points[2 * j + 1]) <= PLACE_MAX))
                reading_fail(r, PAPER_BAD_ARGUMENT, "a path leads further than 1000000 away");
        }
        line[r->lines->count++] = *way;
    }
    free(own.line);
}

static const char *attribute(const XML_Char **attributes, const char *name)
{
    for (int i = 0; attributes[i]; i += 2)
        if (strcmp(attributes[i], name) == 0)
            return attributes[i + 1];
    return NULL;
}

/* Entities of a DOCTYPE can name each other, so deep that expat overflows the stack; no path
 * needs any. */
static void doctype_begin(void *context, const XML_Char *name, const XML_Char *system,
                          const XML_Char *public, int internal)
{
    (void)name;
    (void)system;
    (void)public;
    (void)internal;
    reading_fail(context, PAPER_BAD_ARGUMENT, "it has a DOCTYPE; remove that");
}

static void element_begin(void *context, const XML_Char *name, const XML_Char **attributes)
{
    static const char *const hiding[] = {"defs",   "clipPath", "mask", "symbol",
                                         "marker", "pattern",  "glyph"};
    struct reading *r = context;
    const char *colon = strrchr(name, ':'), *local = colon ? colon + 1 : name;
    if (r->status != PAPER_OK)
        return;
    if (r->depth == 0 && strcmp(local, "svg") != 0) {
        reading_fail(r, PAPER_BAD_ARGUMENT, "it is XML, but not SVG");
        return;
    }
    if (XML_GetSpecifiedAttributeCount(r->parser) > 2 * ATTRIBUTES_MAX) {
        reading_fail(r, PAPER_BAD_ARGUMENT, "an element has more than 1000 attributes");
        return;
    }
    if (r->depth == DEPTH_MAX - 1) {
        reading_fail(r, PAPER_BAD_ARGUMENT, "elements are nested too deeply");
        return;
    }
    struct matrix m = r->depth > 0 ? r->stack[r->depth - 1] : (struct matrix){1, 0, 0, 1, 0, 0};
    bool hides = r->hidden > 0;
    for (size_t i = 0; i < sizeof hiding / sizeof *hiding; i++)
        hides = hides || strcmp(local, hiding[i]) == 0;
    const char *transform = attribute(attributes, "transform"),
               *path = attribute(attributes, "d");
    if (transform && !transform_parse(transform, &m)) {
        reading_fail(r, PAPER_BAD_ARGUMENT, "a transform is none that SVG has");
        return;
    }
    r->stack[r->depth++] = m;
    r->hidden += hides;
    if (!hides && path && strcmp(local, "path") == 0)
        path_add(r, path, &m);
}

static void element_end(void *context, const XML_Char *name)
{
    struct reading *r = context;
    (void)name;
    r->depth -= r->depth > 0;
    r->hidden -= r->hidden > 0;
}

enum paper_status paper_svg_parse(const char *bytes, size_t count, const char *name,
                                  double tolerance, struct paper_lines *lines)
{
    *lines = (struct paper_lines){0};
    if (count > PAPER_FILE_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "%s: an SVG file has up to %d bytes", name,
                          PAPER_FILE_MAX);
    struct reading *r = calloc(1, sizeof *r);
    XML_Parser parser = r ? parser_create(count) : NULL;
    if (!parser) {
        free(r);
        return paper_fail(PAPER_NO_MEMORY, "%s: no memory to read it", name);
    }
    *r = (struct reading){
        .parser = parser, .name = name, .tolerance = tolerance, .lines = lines};
    XML_SetUserData(parser, r);
    XML_SetStartDoctypeDeclHandler(parser, doctype_begin);
    XML_SetElementHandler(parser, element_begin, element_end);
    if (XML_Parse(parser, bytes, (int)count, 1) != XML_STATUS_OK && r->status == PAPER_OK)
        reading_fail(r, PAPER_BAD_ARGUMENT,
                     XML_GetErrorCode(parser) == XML_ERROR_NO_MEMORY
                         ? "it has more elements, names or attributes than a drawing"
                         : XML_ErrorString(XML_GetErrorCode(parser)));
    XML_ParserFree(parser);
    enum paper_status status = r->status;
    free(r);
    if (status != PAPER_OK)
        paper_lines_destroy(lines);
    return status;
}

enum paper_status paper_svg_read(const char *file, double tolerance, struct paper_lines *lines)
{
    char *bytes;
    size_t count;
    *lines = (struct paper_lines){0};
    enum paper_status status = paper_file_read(file, &bytes, &count);
    if (status == PAPER_OK)
        status = paper_svg_parse(bytes, count, file, tolerance, lines);
    free(bytes);
    return status;
}
