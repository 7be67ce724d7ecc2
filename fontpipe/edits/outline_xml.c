/* outline_xml.c - outlines in files of other programs: SVG, and glif, of which a UFO is made.
 * See edits_internal.h.
 *
 * Expat reads them. A file with a DOCTYPE is refused: so nothing in it stands for more than it
 * is. What is drawn and is no path (a circle, a component) is refused by name, since leaving it
 * out would change the glyph. */
#include "edits_internal.h"
#include "xml_line.h"

#include <array.h>

#include <expat.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH_MAX = 64 };
#define NUMBER_MOST 1e7

struct glif_point {
    struct font_point at;
    enum { OFF_CURVE, LINE, CURVE, QCURVE } kind;
};

struct reader {
    const char *path;
    XML_Parser parser;
    struct font_outline *outline;
    double maps[DEPTH_MAX + 1][6]; /* of each depth, in SVG */
    int depth, hidden;             /* hidden: the depth below which nothing is drawn; 0: none */
    bool glif, begun;
    struct glif_point *points; /* of glif's contour */
    int points_count, points_capacity;
    bool in_contour;
    enum font_status status;
};

/* Ends the reading with the reason. */
static void fail_read(struct reader *r, const char *what, const char *name)
{
    if (r->status == FONT_OK)
        r->status = font_fail(FONT_BAD_FILE, "%s:%lu: %s%.100s", r->path, xml_line(r->parser),
                              what, name);
    XML_StopParser(r->parser, XML_FALSE);
}

static void pipeline_failed(struct reader *r)
{
    char what[200];
    snprintf(what, sizeof what, "%.199s", font_error());
    r->status = r->status == FONT_BAD_ARGUMENT || r->status == FONT_BAD_FILE ? FONT_BAD_FILE
                                                                             : r->status;
    r->status = font_fail(r->status, "%s:%lu: %s", r->path, xml_line(r->parser), what);
    XML_StopParser(r->parser, XML_FALSE);
}

static const char *attribute(const char **attributes, const char *name)
{
    for (; attributes[0]; attributes += 2)
        if (strcmp(attributes[0], name) == 0)
            return attributes[1];
    return NULL;
}

/* Numbers separated by white space and commas. Returns how many there are, at most `most`; -1:
 * something else is there. */
static int numbers_take(const char *at, const char *end, double *numbers, int most)
{
    int count = 0;
    for (;;) {
        while (at < end && strchr(" \t\r\n,", *at))
            at++;
        if (at >= end)
            return count;
        char *behind;
        double number = strtod(at, &behind);
        if (behind == at || behind > end || count == most || !(fabs(number) <= NUMBER_MOST))
            return -1;
        numbers[count++] = number;
        at = behind;
    }
}

/* ---- SVG ---- */

/* map = map after `by` */
static void map_after(double map[6], const double by[6])
{
    const double a[6] = {map[0], map[1], map[2], map[3], map[4], map[5]};
    for (int i = 0; i < 2; i++) {
        map[i] = a[i] * by[0] + a[2 + i] * by[1];
        map[2 + i] = a[i] * by[2] + a[2 + i] * by[3];
        map[4 + i] = a[i] * by[4] + a[2 + i] * by[5] + a[4 + i];
    }
}

/* One of transform's functions. */
static bool function_map(const char *name, size_t length, const double *n, int count,
                         double map[6])
{
    const double pi = 3.14159265358979323846;
    if (length == 6 && strncmp(name, "matrix", 6) == 0 && count == 6) {
        memcpy(map, n, 6 * sizeof *map);
    } else if (length == 9 && strncmp(name, "translate", 9) == 0 && count >= 1 && count <= 2) {
        map[4] = n[0];
        map[5] = count == 2 ? n[1] : 0;
    } else if (length == 5 && strncmp(name, "scale", 5) == 0 && count >= 1 && count <= 2) {
        map[0] = n[0];
        map[3] = n[count - 1];
    } else if (length == 6 && strncmp(name, "rotate", 6) == 0 && (count == 1 || count == 3)) {
        double c = cos(n[0] * pi / 180), s = sin(n[0] * pi / 180);
        double x = count == 3 ? n[1] : 0, y = count == 3 ? n[2] : 0;
        const double turned[6] = {c, s, -s, c, x - c * x + s * y, y - s * x - c * y};
        memcpy(map, turned, sizeof turned);
    } else {
        return false;
    }
    return true;
}

static bool transform_take(const char *text, double map[6])
{
    for (const char *at = text + strspn(text, " \t\r\n,"); *at;) {
        double n[6], by[6] = {1, 0, 0, 1, 0, 0};
        size_t length = strcspn(at, "( ");
        const char *open = at + length + strspn(at + length, " "), *close = strchr(at, ')');
        if (*open != '(' || !close || close < open)
            return false;
        int count = numbers_take(open + 1, close, n, 6);
        if (count < 0 || !function_map(at, length, n, count, by))
            return false;
        map_after(map, by);
        at = close + 1;
        at += strspn(at, " \t\r\n,");
    }
    return true;
}

static bool is_one_of(const char *name, const char *const *words)
{
    for (; *words; words++)
        if (strcmp(name, *words) == 0)
            return true;
    return false;
}

static void svg_begin(struct reader *r, const char *name, const char **attributes)
{
    static const char *const drawn[] = {"rect",    "circle", "ellipse", "line",  "polyline",
                                        "polygon", "text",   "use",     "image", NULL};
    static const char *const hidden[] = {"defs",   "clipPath", "mask",          "pattern",
                                         "symbol", "marker",   "foreignObject", NULL};
    double *map = r->maps[r->depth];
    const char *transform = attribute(attributes, "transform");
    if (r->hidden)
        return;
    if (strncmp(name, "svg:", 4) == 0)
        name += 4;
    if (transform && !transform_take(transform, map)) {
        fail_read(r, "a transform that is none of matrix, translate, scale and rotate", "");
    } else if (strcmp(name, "svg") == 0) {
        double box[4];
        const char *view = attribute(attributes, "viewBox");
        if (view && numbers_take(view, view + strlen(view), box, 4) != 4)
            fail_read(r, "viewBox has four numbers", "");
        else if (view)
            r->outline->advance = box[2];
    } else if (strcmp(name, "path") == 0) {
        const char *d = attribute(attributes, "d"), *why = NULL;
        enum font_status status = d ? edits_path_draw(d, map, r->outline, &why) : FONT_OK;
        if (status != FONT_OK && why) {
            fail_read(r, "a path ", why);
        } else if (status != FONT_OK) {
            r->status = status;
            pipeline_failed(r);
        }
    } else if (is_one_of(name, drawn)) {
        fail_read(r, "only paths are read; make a path of this ", name);
    } else if (is_one_of(name, hidden)) {
        r->hidden = r->depth;
    }
}

/* ---- glif ---- */

static double number_of(struct reader *r, const char **attributes, const char *name)
{
    double number = 0;
    const char *text = attribute(attributes, name);
    if (!text || numbers_take(text, text + strlen(text), &number, 1) != 1)
        fail_read(r, "there is no number in ", name);
    return number;
}

static void point_take(struct reader *r, const char **attributes)
{
    static const char *const kinds[] = {"offcurve", "line", "curve", "qcurve"};
    const char *type = attribute(attributes, "type");
    struct glif_point point = {{number_of(r, attributes, "x"), number_of(r, attributes, "y")},
                               OFF_CURVE};
    int kind = 0;
    while (type && kind < 4 && strcmp(kinds[kind], type) != 0)
        kind++;
    if (type && strcmp(type, "move") == 0)
        kind = LINE;
    if (kind == 4) {
        fail_read(r, "a point is no ", type);
        return;
    }
    if (r->status != FONT_OK)
        return;
    if (r->points_count == FONT_SEGMENTS_MAX) {
        fail_read(r, "a contour has too many points", "");
        return;
    }
    point.kind = kind == 0 ? OFF_CURVE : kind == 1 ? LINE : kind == 2 ? CURVE : QCURVE;
    if (!array_reserve(&r->points, &r->points_capacity, r->points_count + 1,
                       sizeof *r->points)) {
        r->status = font_fail(FONT_NO_MEMORY, "no memory for %s", r->path);
        XML_StopParser(r->parser, XML_FALSE);
        return;
    }
    r->points[r->points_count++] = point;
}

static struct font_point middle(struct font_point a, struct font_point b)
{
    return (struct font_point){(a.x + b.x) / 2, (a.y + b.y) / 2};
}

/* The way to a point on the curve, which `held` points from number `first` lie before. */
static void way_draw(struct reader *r, int first, int held, const struct glif_point *to,
                     bool quadratic)
{
    struct font_outline *o = r->outline;
    int n = r->points_count;
    const struct font_point a = held ? r->points[first % n].at : to->at,
                            b = held > 1 ? r->points[(first + 1) % n].at : a;
    if (held == 0) {
        r->status = font_outline_line(o, to->at.x, to->at.y);
    } else if (!quadratic && held == 2) {
        r->status = font_outline_cubic(o, a.x, a.y, b.x, b.y, to->at.x, to->at.y);
    } else if (!quadratic && held > 2) {
        fail_read(r, "a curve has more than two points that are off it", "");
    } else {
        for (int i = 0; i < held && r->status == FONT_OK; i++) {
            struct font_point c = r->points[(first + i) % n].at, next = to->at;
            if (i + 1 < held)
                next = middle(c, r->points[(first + i + 1) % n].at);
            r->status = font_outline_quad(o, c.x, c.y, next.x, next.y);
        }
    }
}

static void contour_draw(struct reader *r)
{
    int n = r->points_count, start = 0;
    if (n < 2) /* an anchor, or nothing */
        return;
    while (start < n && r->points[start].kind == OFF_CURVE)
        start++;
    bool none_on = start == n;
    struct glif_point first =
        none_on ? (struct glif_point){middle(r->points[n - 1].at, r->points[0].at), QCURVE}
                : r->points[start];
    if (none_on)
        start = -1;
    r->status = font_outline_move(r->outline, first.at.x, first.at.y);
    int held = 0, steps = none_on ? n + 1 : n;
    for (int k = 1; k <= steps && r->status == FONT_OK; k++) {
        bool closes = k == steps;
        const struct glif_point *p = closes ? &first : &r->points[(start + k) % n];
        if (p->kind == OFF_CURVE) {
            held++;
            continue;
        }
        way_draw(r, start + k - held, held, p, p->kind == QCURVE);
        held = 0;
    }
    if (r->status == FONT_OK)
        r->status = font_outline_close(r->outline);
    if (r->status != FONT_OK)
        pipeline_failed(r);
}

static void glif_begin(struct reader *r, const char *name, const char **attributes)
{
    if (strcmp(name, "advance") == 0 && attribute(attributes, "width")) {
        r->outline->advance = number_of(r, attributes, "width");
    } else if (strcmp(name, "contour") == 0) {
        r->points_count = 0;
        r->in_contour = true;
    } else if (strcmp(name, "point") == 0 && r->in_contour) {
        point_take(r, attributes);
    } else if (strcmp(name, "component") == 0) {
        fail_read(r, "components are not read; take the glyph apart into contours", "");
    }
}

/* ---- both ---- */

static void XMLCALL element_begin(void *data, const char *name, const char **attributes)
{
    struct reader *r = data;
    if (r->status != FONT_OK)
        return;
    if (!r->begun) {
        r->begun = true;
        r->glif = strcmp(name, "glyph") == 0;
        if (!r->glif && strcmp(name, "svg") != 0 && strcmp(name, "svg:svg") != 0) {
            fail_read(r, "an outline is <svg> or glif's <glyph>, not ", name);
            return;
        }
    }
    if (r->depth == DEPTH_MAX) {
        fail_read(r, "its elements are too deep in each other", "");
        return;
    }
    r->depth++;
    memcpy(r->maps[r->depth], r->maps[r->depth - 1], sizeof r->maps[0]);
    if (r->glif)
        glif_begin(r, name, attributes);
    else
        svg_begin(r, name, attributes);
}

static void XMLCALL element_end(void *data, const char *name)
{
    struct reader *r = data;
    if (r->status != FONT_OK)
        return;
    if (r->glif && strcmp(name, "contour") == 0 && r->in_contour) {
        r->in_contour = false;
        contour_draw(r);
    }
    if (r->hidden == r->depth)
        r->hidden = 0;
    r->depth--;
}

static void XMLCALL doctype_begin(void *data, const char *name, const char *system,
                                  const char *public, int internal)
{
    (void)name, (void)system, (void)public, (void)internal;
    fail_read(data, "it has a DOCTYPE", "");
}

enum font_status edits_outline_read(const char *path, const char *bytes, size_t count,
                                    struct font_outline *out)
{
    struct reader r = {.path = path, .outline = out, .maps = {{1, 0, 0, -1, 0, 0}}};
    r.parser = XML_ParserCreate(NULL);
    if (!r.parser)
        return font_fail(FONT_NO_MEMORY, "no memory for %s", path);
    XML_SetUserData(r.parser, &r);
    XML_SetElementHandler(r.parser, element_begin, element_end);
    XML_SetStartDoctypeDeclHandler(r.parser, doctype_begin);
    if (XML_Parse(r.parser, bytes, (int)count, 1) == XML_STATUS_ERROR && r.status == FONT_OK)
        r.status = font_fail(FONT_BAD_FILE, "%s:%lu: %s", path, xml_line(r.parser),
                             XML_ErrorString(XML_GetErrorCode(r.parser)));
    XML_ParserFree(r.parser);
    free(r.points);
    return r.status;
}
