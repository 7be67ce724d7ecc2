/* remarks.c - see reader_remarks.h. */
#include "anchor_internal.h"
#include "remarks_internal.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

struct reader_remarks {
    struct remarks_file *file;
    struct remark_rows rows;
    struct remark_layers layers;
};

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* It is where the anchor is that it hangs on. */
static void one_hangs(struct reader_remarks *remarks, int i)
{
    struct reader_remark *r = &remarks->rows.rows[i].remark;
    const struct remark_row *on = &remarks->rows.rows[r->hangs];
    r->anchor = on->anchor;
    r->begin = on->place.begin;
    r->end = on->place.end;
    r->orphan = on->place.orphan;
}

static void all_hang(struct reader_remarks *remarks)
{
    for (int i = 0; i < remarks->rows.count; i++)
        one_hangs(remarks, i);
}

static enum reader_status open_as(const char *path, bool reads, struct reader_remarks **out)
{
    struct reader_remarks *remarks = calloc(1, sizeof *remarks);
    *out = NULL;
    if (!remarks)
        return reader_fail(READER_NO_MEMORY, "no memory for notes");
    enum reader_status status =
        remarks_file_open(path, reads, &remarks->file, &remarks->rows, &remarks->layers);
    if (status != READER_OK) {
        reader_remarks_close(remarks);
        return status;
    }
    for (int i = 0; i < remarks->rows.count; i++) {
        struct remark_row *row = &remarks->rows.rows[i];
        row->place.orphan = true; /* until it is found */
        row->remark.by = remarks->layers.names[row->remark.layer];
    }
    all_hang(remarks);
    *out = remarks;
    return READER_OK;
}

enum reader_status reader_remarks_open(const char *path, struct reader_remarks **out)
{
    return open_as(path, false, out);
}

enum reader_status reader_remarks_read(const char *path, struct reader_remarks **out)
{
    return open_as(path, true, out);
}

void reader_remarks_close(struct reader_remarks *remarks)
{
    if (!remarks)
        return;
    remarks_file_close(remarks->file);
    for (int i = 0; i < remarks->rows.count; i++)
        remark_row_finish(&remarks->rows.rows[i]);
    free(remarks->rows.rows);
    free(remarks);
}

int reader_remarks_count(const struct reader_remarks *remarks)
{
    return remarks->rows.count;
}

const struct reader_remark *reader_remarks_get(const struct reader_remarks *remarks, int i)
{
    return &remarks->rows.rows[i].remark;
}

bool reader_remarks_read_only(const struct reader_remarks *remarks)
{
    return remarks_file_read_only(remarks->file);
}

/* ---- anchors ---- */

/* An anchor of where it is now, kept too: the next change of the text is found from here. */
static enum reader_status anchor_renew(struct reader_remarks *remarks, struct remark_row *row,
                                       const char *plain, size_t bytes)
{
    struct reader_anchor *before = row->anchor, *now;
    enum reader_status status =
        reader_anchor_make(plain, bytes, row->place.begin, row->place.end, &now);
    if (status != READER_OK)
        return status;
    row->anchor = now;
    if (!reader_remarks_read_only(remarks))
        status = remarks_file_write(remarks->file, row);
    if (status != READER_OK) {
        row->anchor = before;
        reader_anchor_destroy(now);
        return status;
    }
    reader_anchor_destroy(before);
    return READER_OK;
}

enum reader_status reader_remarks_find(struct reader_remarks *remarks, const char *plain,
                                       size_t bytes)
{
    enum reader_status status = READER_OK;
    for (int i = 0; i < remarks->rows.count; i++) {
        struct remark_row *row = &remarks->rows.rows[i];
        const enum reader_found found =
            reader_anchor_find(row->anchor, plain, bytes, &row->place.begin, &row->place.end);
        row->place.orphan = found == READER_ANCHOR_ORPHAN;
        if (found == READER_ANCHOR_MOVED && status == READER_OK)
            status = anchor_renew(remarks, row, plain, bytes);
    }
    all_hang(remarks);
    return status;
}

/* ---- edits ---- */

void reader_remarks_edit(struct reader_remarks *remarks, size_t at, size_t removed,
                         size_t inserted)
{
    for (int i = 0; i < remarks->rows.count; i++) {
        struct reader_remark_place *p = &remarks->rows.rows[i].place;
        if (!p->orphan)
            p->orphan = !anchor_range_edit(&p->begin, &p->end, at, removed, inserted);
    }
    all_hang(remarks);
}

struct reader_remark_place reader_remarks_place_of(const struct reader_remarks *remarks, int i)
{
    struct reader_remark_place place = remarks->rows.rows[i].place;
    place.index = i;
    return place;
}

void reader_remarks_place(struct reader_remarks *remarks,
                          const struct reader_remark_place *places, int count)
{
    for (int i = 0; i < count; i++)
        remarks->rows.rows[places[i].index].place = places[i];
    all_hang(remarks);
}

enum reader_status reader_remarks_saved(struct reader_remarks *remarks, const char *plain,
                                        size_t bytes)
{
    enum reader_status status = READER_OK;
    for (int i = 0; i < remarks->rows.count && status == READER_OK; i++) {
        struct remark_row *row = &remarks->rows.rows[i];
        if (!row->place.orphan)
            status = anchor_renew(remarks, row, plain, bytes);
    }
    all_hang(remarks);
    return status;
}

/* ---- changes ---- */

static enum reader_status what_check(const struct reader_remark *what)
{
    if (what->points_count < 0 || what->points_count > READER_INK_POINTS_MAX ||
        (what->points_count > 0) != (what->kind == READER_REMARK_INK))
        return reader_fail(READER_BAD_ARGUMENT, "ink has 1..%d points (got %d)",
                           READER_INK_POINTS_MAX, what->points_count);
    if (!(what->made_s >= 0 && what->made_s <= REMARKS_TIME_MOST_S))
        return reader_fail(READER_BAD_ARGUMENT, "a note is not made at %g s", what->made_s);
    if (what->text && strlen(what->text) > READER_TYPED_MAX)
        return reader_fail(READER_TOO_LARGE, "a note has up to %d bytes (got %zu)",
                           READER_TYPED_MAX, strlen(what->text));
    return READER_OK;
}

static enum reader_status row_make(const struct reader_remark *what, const char *plain,
                                   size_t bytes, size_t begin, size_t end,
                                   struct remark_row *row)
{
    const size_t size = (size_t)what->points_count * sizeof *what->points;
    *row = (struct remark_row){.remark = *what};
    struct reader_remark *r = &row->remark;
    r->made_s = what->made_s > 0 ? what->made_s : now_s();
    r->gone_s = 0;
    r->hidden = false;
    r->scale_x = r->scale_y = 1;
    r->group = -1;
    r->around = READER_AROUND_NOT;
    row->place = (struct reader_remark_place){0, begin, end, false};
    r->text = strdup(what->text ? what->text : "");
    r->points = malloc(size + 1);
    enum reader_status status = r->text && r->points
                                    ? reader_anchor_make(plain, bytes, begin, end, &row->anchor)
                                    : reader_fail(READER_NO_MEMORY, "no memory for a note");
    if (status == READER_OK && size)
        memcpy(r->points, what->points, size);
    return status;
}

enum reader_status reader_remarks_add(struct reader_remarks *remarks,
                                      const struct reader_remark *what, const char *plain,
                                      size_t bytes, size_t begin, size_t end, int *index)
{
    struct remark_rows *rows = &remarks->rows;
    struct remark_row row;
    enum reader_status status = what_check(what);
    if (status != READER_OK)
        return status;
    if (rows->count == READER_REMARKS_MAX)
        return reader_fail(READER_TOO_LARGE, "a document has up to %d notes",
                           READER_REMARKS_MAX);
    status = row_make(what, plain, bytes, begin, end, &row);
    row.remark.layer = remarks->layers.written;
    row.remark.by = remarks->layers.names[row.remark.layer];
    if (status == READER_OK &&
        !array_reserve(&rows->rows, &rows->capacity, rows->count + 1, sizeof *rows->rows))
        status = reader_fail(READER_NO_MEMORY, "no memory for a note");
    if (status == READER_OK)
        status = remarks_file_write(remarks->file, &row);
    if (status != READER_OK) {
        remark_row_finish(&row);
        return status;
    }
    *index = row.remark.hangs = rows->count;
    rows->rows[rows->count++] = row;
    one_hangs(remarks, *index);
    return READER_OK;
}

static struct remark_row *row_of(struct reader_remarks *remarks, int i)
{
    return i >= 0 && i < remarks->rows.count ? &remarks->rows.rows[i] : NULL;
}

/* It is there, and in the layer that is written. */
static enum reader_status row_check(struct reader_remarks *remarks, int i)
{
    const struct remark_row *row = row_of(remarks, i);
    if (!row)
        return reader_fail(READER_BAD_ARGUMENT, "there is no note %d", i);
    if (row->remark.layer != remarks->layers.written)
        return reader_fail(READER_BAD_ARGUMENT,
                           "this is in the layer %s: it is changed where that is written",
                           *row->remark.by ? row->remark.by : "that has no name");
    return READER_OK;
}

/* Writes it, or leaves it as it was. */
static enum reader_status row_change(struct reader_remarks *remarks, int i,
                                     const struct reader_remark *to)
{
    struct remark_row *row = row_of(remarks, i);
    if (row_check(remarks, i) != READER_OK)
        return READER_BAD_ARGUMENT;
    const struct reader_remark before = row->remark;
    row->remark = *to;
    enum reader_status status = remarks_file_write(remarks->file, row);
    if (status != READER_OK)
        row->remark = before;
    return status;
}

enum reader_status reader_remarks_erase(struct reader_remarks *remarks, int i, bool erased)
{
    struct reader_remark to = {0};
    if (row_of(remarks, i))
        to = row_of(remarks, i)->remark;
    to.gone_s = erased ? now_s() : 0;
    return row_change(remarks, i, &to);
}

/* ---- arranging ---- */

struct reader_arranged reader_remarks_arranged(const struct reader_remarks *remarks, int i)
{
    const struct reader_remark *r = reader_remarks_get(remarks, i);
    return (struct reader_arranged){i,          r->x,     r->y,     r->scale_x,
                                    r->scale_y, r->hangs, r->group, r->around};
}

static bool is_within(double value, double least, double most)
{
    return value >= least && value <= most;
}

static enum reader_status arranged_check(struct reader_remarks *remarks,
                                         const struct reader_arranged *to)
{
    const double moved = READER_MOVED_MOST, least = READER_SCALE_LEAST,
                 most = READER_SCALE_MOST;
    if (row_check(remarks, to->index) != READER_OK)
        return READER_BAD_ARGUMENT;
    if (reader_remarks_get(remarks, to->index)->kind != READER_REMARK_INK)
        return reader_fail(READER_BAD_ARGUMENT, "only ink is arranged");
    if (!is_within(to->x, -moved, moved) || !is_within(to->y, -moved, moved))
        return reader_fail(READER_BAD_ARGUMENT, "ink cannot be moved by %g, %g ems", to->x,
                           to->y);
    if (!is_within(to->scale_x, least, most) || !is_within(to->scale_y, least, most))
        return reader_fail(READER_BAD_ARGUMENT, "ink is scaled by %g to %g (got %g, %g)", least,
                           most, to->scale_x, to->scale_y);
    if (!row_of(remarks, to->hangs) || (to->group != -1 && !row_of(remarks, to->group)))
        return reader_fail(READER_BAD_ARGUMENT, "ink hangs on no note %d, group %d", to->hangs,
                           to->group);
    if ((unsigned)to->around > READER_AROUND_RIGHT)
        return reader_fail(READER_BAD_ARGUMENT, "text does not flow around ink by %d",
                           (int)to->around);
    return READER_OK;
}

enum reader_status reader_remarks_arrange(struct reader_remarks *remarks,
                                          const struct reader_arranged *to, int count)
{
    enum reader_status status = READER_OK;
    for (int i = 0; i < count && status == READER_OK; i++)
        status = arranged_check(remarks, &to[i]);
    if (status == READER_OK)
        status = remarks_file_arrange(remarks->file, &remarks->rows, to, count);
    for (int i = 0; i < count && status == READER_OK; i++) {
        struct reader_remark *r = &remarks->rows.rows[to[i].index].remark;
        r->x = to[i].x;
        r->y = to[i].y;
        r->scale_x = to[i].scale_x;
        r->scale_y = to[i].scale_y;
        r->hangs = to[i].hangs;
        r->group = to[i].group;
        r->around = to[i].around;
    }
    all_hang(remarks);
    return status;
}

enum reader_status reader_remarks_write(struct reader_remarks *remarks, int i, const char *text)
{
    struct reader_remark to = {0};
    if (row_of(remarks, i))
        to = row_of(remarks, i)->remark;
    char *before = to.text;
    to.text = strlen(text) <= READER_TYPED_MAX ? strdup(text) : NULL;
    if (!to.text)
        return reader_fail(READER_TOO_LARGE, "a note has up to %d bytes", READER_TYPED_MAX);
    enum reader_status status = row_change(remarks, i, &to);
    free(status == READER_OK ? before : to.text);
    return status;
}

/* ---- layers ---- */

int reader_remarks_layers(const struct reader_remarks *remarks)
{
    return remarks->layers.count;
}

static bool is_layer(const struct reader_remarks *remarks, int layer)
{
    return layer >= 0 && layer < remarks->layers.count;
}

const char *reader_remarks_layer(const struct reader_remarks *remarks, int layer)
{
    return is_layer(remarks, layer) ? remarks->layers.names[layer] : "";
}

bool reader_remarks_layer_shown(const struct reader_remarks *remarks, int layer)
{
    return is_layer(remarks, layer) && !remarks->layers.hidden[layer];
}

void reader_remarks_layer_show(struct reader_remarks *remarks, int layer, bool shown)
{
    if (!is_layer(remarks, layer))
        return;
    remarks->layers.hidden[layer] = !shown;
    for (int i = 0; i < remarks->rows.count; i++) {
        struct reader_remark *r = &remarks->rows.rows[i].remark;
        r->hidden = remarks->layers.hidden[r->layer];
    }
}

int reader_remarks_written(const struct reader_remarks *remarks)
{
    return remarks->layers.written;
}

void reader_remarks_write_layer(struct reader_remarks *remarks, int layer)
{
    if (!is_layer(remarks, layer))
        return;
    remarks->layers.written = layer;
    reader_remarks_layer_show(remarks, layer, true);
}

enum reader_status reader_remarks_layer_add(struct reader_remarks *remarks, const char *name,
                                            int *layer)
{
    struct remark_layers *layers = &remarks->layers;
    if (!remark_layer_named(name))
        return reader_fail(READER_BAD_ARGUMENT,
                           "a layer's name has 1..%d bytes of UTF-8 that can be seen",
                           READER_LAYER_BYTES - 1);
    for (*layer = 1; *layer < layers->count; ++*layer)
        if (strcmp(layers->names[*layer], name) == 0)
            return READER_OK;
    return remarks_file_layer(remarks->file, name, layers, layer);
}

enum reader_status reader_remarks_sync(struct reader_remarks *remarks)
{
    return remarks_file_sync(remarks->file);
}
