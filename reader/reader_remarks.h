/* reader_remarks.h - what readers leave in a document: highlights, typed notes, ink; kept
 * beside it in a file of SQLite.
 *
 *     struct reader_remarks *remarks;
 *     if (reader_remarks_open("marsh.md.notes", &remarks) != READER_OK)
 *         // foreign, damaged: it is left as it is
 *         tell(reader_error());
 *     reader_remarks_find(remarks, document->plain, document->plain_bytes);
 *     for (int i = 0; i < reader_remarks_count(remarks); i++)
 *         show(reader_remarks_get(remarks, i));
 *     reader_remarks_add(remarks, &remark, plain, bytes, 120, 145, &index);
 *     reader_remarks_close(remarks);
 *
 * A remark hangs on an anchor (reader_anchor.h) of bytes of the document's plain text. What an
 * anchor does not find is an orphan, and is listed still. Nothing is ever taken out of the
 * file: what is erased is marked so, with the time, and can be had back.
 *
 * The file is made at the first remark. Each change is in it before the function returns, so a
 * program that is killed has lost nothing; reader_remarks_sync() makes it safe from a loss of
 * power, too. Several programs may have the file open; each sees what was there when it opened
 * it, and its own.
 *
 * Arranging. A stroke is moved and scaled; its points stay what they were. Strokes of a group
 * are taken together, and hang on one anchor, that of one of them, so that a drawing stays
 * whole when its words part. A file is of a later version when a first stroke is scaled or
 * grouped.
 *
 * Text flows around ink that says so. It is then counted from the paragraph that its anchor is
 * in: from an edge of that one's column, and from its upper edge (reader_around.h). A file is
 * of a later version when a first stroke says so.
 *
 * Layers. A file has the notes of several readers, each in a layer with a name; the first one
 * has none. All are shown but those that are hidden, and one is written: what is added is in
 * it, and only what is in it can be changed. Which are hidden and which is written is not kept.
 * A file gets layers, and is then of a later version, when the first one is added.
 *
 * Ink. Points are in ems from the upper left corner of the anchor's first letter, with a
 * pressure of 0..1 and the seconds since its first one: so it moves with the text, grows with
 * it, and is played back.
 *
 * Errors: functions that can fail return a status and leave one line in reader_error().
 * Ownership: what is passed is copied. Threads: one at a time. */
#ifndef LUTETIA_READER_REMARKS_H
#define LUTETIA_READER_REMARKS_H

#include "reader_anchor.h"

struct reader_remarks;

enum reader_remark_kind { READER_REMARK_HIGHLIGHT, READER_REMARK_TYPED, READER_REMARK_INK };

struct reader_ink_point {
    float x, y, pressure, time_s;
};

enum {
    READER_REMARKS_MAX = 100000,
    READER_INK_POINTS_MAX = 100000,
    READER_TYPED_MAX = 1 << 20,
    READER_LAYERS_MAX = 32,
    READER_LAYER_BYTES = 64 /* of a name, with its end */
};

/* Whether text flows around ink, and from which edge of its column it is counted. */
enum reader_around { READER_AROUND_NOT, READER_AROUND_LEFT, READER_AROUND_RIGHT };

struct reader_remark {
    enum reader_remark_kind kind;
    double made_s;           /* since 1970; of ink: when its last point was drawn */
    double gone_s;           /* when it was erased; 0: it was not */
    char *text;              /* UTF-8; "" for none */
    unsigned rgba;           /* red in the highest byte */
    double width;            /* of ink at full pressure, in ems */
    double x, y;             /* by how much it was moved, in ems */
    double scale_x, scale_y; /* of its points, from the anchor */
    int hangs;               /* whose anchor it hangs on: a remark's, most often its own */
    int group;               /* a remark that the group is called by; -1: it is in none */
    enum reader_around around;
    struct reader_ink_point *points;
    int points_count;
    const struct reader_anchor *anchor; /* that it hangs on */
    bool orphan;
    size_t begin, end; /* where that was found */
    int layer;
    const char *by; /* the layer's name */
    bool hidden;    /* its layer is */
};
/* It is to be shown: neither erased nor hidden. */
static inline bool reader_remark_seen(const struct reader_remark *r)
{
    return !(r->gone_s > 0) && !r->hidden;
}

/* Errors: FAILED (not a file of remarks, a newer version's, damaged, cannot be read),
 * NO_MEMORY, NO_LIBRARY. Owns: the caller closes *out. */
enum reader_status reader_remarks_open(const char *path, struct reader_remarks **out);
/* The same to be read alone: no remark is written, not even where one has moved. Errors: the
 * same. */
enum reader_status reader_remarks_read(const char *path, struct reader_remarks **out);
void reader_remarks_close(struct reader_remarks *remarks); /* NULL is fine */
int reader_remarks_count(const struct reader_remarks *remarks);
/* Valid until remarks are added or closed. */
const struct reader_remark *reader_remarks_get(const struct reader_remarks *remarks, int i);
/* The file can be read only: remarks are shown, and adding some fails. */
bool reader_remarks_read_only(const struct reader_remarks *remarks);

/* How many layers there are: at least 1. */
int reader_remarks_layers(const struct reader_remarks *remarks);
/* Its name; "" for the first one, and for one that there is not. */
const char *reader_remarks_layer(const struct reader_remarks *remarks, int layer);
bool reader_remarks_layer_shown(const struct reader_remarks *remarks, int layer);
void reader_remarks_layer_show(struct reader_remarks *remarks, int layer, bool shown);
/* The one that is written: the first, until another one is chosen, which is then shown. */
int reader_remarks_written(const struct reader_remarks *remarks);
void reader_remarks_write_layer(struct reader_remarks *remarks, int layer);
/* One more, or the one that has that name. Errors: BAD_ARGUMENT (a name has 1..63 bytes of
 * UTF-8 and no signs that are not seen), TOO_LARGE, FAILED (it cannot be written). */
enum reader_status reader_remarks_layer_add(struct reader_remarks *remarks, const char *name,
                                            int *layer);

/* Finds all anchors in a text. Those that have moved are anchored anew, there. Errors: FAILED,
 * NO_MEMORY; what was found is known. */
enum reader_status reader_remarks_find(struct reader_remarks *remarks, const char *plain,
                                       size_t bytes);
/* Bytes at..at + removed of the text that they were found in become `inserted` others: each
 * goes with its letters, or is an orphan when all of them are gone. Its anchor is what it was:
 * where the edit is not saved, it is found at its place again. */
void reader_remarks_edit(struct reader_remarks *remarks, size_t at, size_t removed,
                         size_t inserted);
/* Where its own anchor was found, whatever it hangs on. */
struct reader_remark_place {
    int index;
    size_t begin, end;
    bool orphan;
};
struct reader_remark_place reader_remarks_place_of(const struct reader_remarks *remarks, int i);
/* They are where they were before an edit that is undone. */
void reader_remarks_place(struct reader_remarks *remarks,
                          const struct reader_remark_place *places, int count);
/* The text is saved: all that are in it are anchored anew, there. Errors: FAILED, NO_MEMORY. */
enum reader_status reader_remarks_saved(struct reader_remarks *remarks, const char *plain,
                                        size_t bytes);
/* Of what: kind, text, rgba, width, points, and made_s where it was made before (0: now).
 * Errors: BAD_ARGUMENT, TOO_LARGE, FAILED (it cannot
 * be written), NO_MEMORY; there is then none more. */
enum reader_status reader_remarks_add(struct reader_remarks *remarks,
                                      const struct reader_remark *what, const char *plain,
                                      size_t bytes, size_t begin, size_t end, int *index);
/* Erases it, or has it back. Errors: BAD_ARGUMENT (its layer is not written, too), FAILED; it
 * is then as it was. */
enum reader_status reader_remarks_erase(struct reader_remarks *remarks, int i, bool erased);
/* Of ink: how it lies, what it hangs on, and which group it is in. */
struct reader_arranged {
    int index;
    double x, y, scale_x, scale_y; /* READER_SCALE_LEAST..MOST */
    int hangs, group;
    enum reader_around around;
};
#define READER_SCALE_LEAST 0.01
#define READER_SCALE_MOST 100.0
#define READER_MOVED_MOST 1e6 /* ems */
struct reader_arranged reader_remarks_arranged(const struct reader_remarks *remarks, int i);
/* All of them are arranged so, or, where one cannot be, none. Errors: BAD_ARGUMENT (not ink,
 * out of range, its layer is not written), FAILED. */
enum reader_status reader_remarks_arrange(struct reader_remarks *remarks,
                                          const struct reader_arranged *to, int count);
enum reader_status reader_remarks_write(struct reader_remarks *remarks, int i,
                                        const char *text);
/* A stroke that is played back, and when it begins. */
struct reader_played {
    int index;
    double begins_s;
};
#define READER_PAUSE_MOST_S 0.4 /* between strokes, however long the hand has rested */
/* Ink in the order in which it was drawn, whatever order it was kept in: pieces of a stroke at
 * the times at which they were drawn. played: room for all remarks; *count: how many there are.
 * erased: with what is erased. Returns how long all of it lasts. */
double reader_remarks_play(const struct reader_remarks *remarks, bool erased,
                           struct reader_played *played, int *count);
/* How wide a stroke is between its point i and the one before, as it was pressed; full: at full
 * pressure. */
double reader_ink_width(const struct reader_ink_point *points, int i, double full);
/* A point of ink as it is scaled, in ems from where the stroke was moved to, and how wide it is
 * between the point before and it. */
struct reader_ink_place {
    double x, y, width;
};
struct reader_ink_place reader_ink_place(const struct reader_remark *r, int i);
/* What has changed is safe from a loss of power. */
enum reader_status reader_remarks_sync(struct reader_remarks *remarks);

#endif
