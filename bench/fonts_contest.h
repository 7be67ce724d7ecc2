/* fonts_contest.h - letters of a face drawn in several ways at a size, which run alternately,
 * for `lutetia bench fonts`.
 *
 *     struct fonts_contest *c = calloc(1, sizeof *c);
 *     fonts_contest_filter(c, "box");
 *     fonts_contest_open(c, "DejaVuSans") && fonts_contest_size(c, 12.25);
 *     struct fonts_contender all[] = {{.what = "box", .draw = fonts_outline_draw}};
 *     fonts_contend(c, all, 1);
 *     fonts_contest_destroy(c);
 *
 * Each letter is at a place of its own between pixels. A turn's time is the thread's processor
 * time, so that other load has little influence; a turn draws the letters as often as takes
 * about a millisecond. Functions return false on failure: bench_error() says why. */
#ifndef LUTETIA_BENCH_FONTS_CONTEST_H
#define LUTETIA_BENCH_FONTS_CONTEST_H

#include "fonts_peers.h"
#include "harness.h"

#include <edges.h>
#include <face.h>
#include <filter.h>
#include <gray.h>

enum { FONTS_LETTERS = 94, FONTS_FACES = 5, FONTS_FILTERS_MAX = 16, FONTS_TURNS = 9 };

extern const char *const fonts_faces[FONTS_FACES];

struct fonts_contest {
    struct font_face *face;
    struct font_outline outlines[FONTS_LETTERS];
    uint32_t glyphs[FONTS_LETTERS];
    double units, x[FONTS_LETTERS], y[FONTS_LETTERS];
    struct font_map map;
    struct font_filter *filters[FONTS_FILTERS_MAX];
    int filters_count;
    struct font_edges kept[FONTS_FILTERS_MAX][FONTS_LETTERS], scratch;
    struct font_gray gray, picture;
    struct peer_freetype *freetype;
    struct peer_stb *stb;
};

/* One way to draw all letters. filter: its number; -1 for a peer. */
struct fonts_contender {
    char what[32];
    int filter;
    bool (*draw)(struct fonts_contest *c, int filter, int letter);
    int rounds;
    double turns[FONTS_TURNS];
    struct bench_sample seconds; /* the result, for all letters */
};

bool fonts_contest_filter(struct fonts_contest *c, const char *name);
bool fonts_contest_open(struct fonts_contest *c, const char *font); /* in place of another */
bool fonts_contest_size(struct fonts_contest *c, double px);
bool fonts_contend(struct fonts_contest *c, struct fonts_contender *all, int count);
void fonts_contest_destroy(struct fonts_contest *c); /* NULL is fine */

/* The ways: edges made of an outline in font units, and drawn; edges that are kept, drawn; the
 * glyph read from the font in memory, and all that follows. */
bool fonts_outline_draw(struct fonts_contest *c, int filter, int letter);
bool fonts_kept_draw(struct fonts_contest *c, int filter, int letter);
bool fonts_file_draw(struct fonts_contest *c, int filter, int letter);
/* FreeType: loads from the font in memory, and renders; renders scaled outlines that are kept.
 * stb_truetype. */
bool fonts_freetype_draw(struct fonts_contest *c, int filter, int letter);
bool fonts_raster_draw(struct fonts_contest *c, int filter, int letter);
bool fonts_stb_draw(struct fonts_contest *c, int filter, int letter);

#endif
