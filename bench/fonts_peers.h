/* fonts_peers.h - other ways to the same glyphs, for `lutetia bench fonts`: FreeType,
 * stb_truetype, and filtering a large bitmap directly.
 *
 *     struct peer_freetype *ft = peer_freetype_create(bytes, count, 12.25);
 *     peer_freetype_draw(ft, glyph, 0.25, 0, &gray);      // loads and renders
 *     peer_freetype_destroy(ft);
 *
 * Pictures are struct font_gray, so that they are compared as ours are; their pixels belong to
 * the peer until its next drawing. Functions return false where the peer failed. */
#ifndef LUTETIA_BENCH_FONTS_PEERS_H
#define LUTETIA_BENCH_FONTS_PEERS_H

#include <gray.h>
#include <master.h>

#include <stdbool.h>

struct peer_freetype;
struct peer_freetype *peer_freetype_create(const void *bytes, size_t count, double size_px);
void peer_freetype_destroy(struct peer_freetype *p);
/* Loads the glyph, moves it and renders it: unhinted, 256 grays. */
bool peer_freetype_draw(struct peer_freetype *p, uint32_t glyph, double x_px, double y_px,
                        struct font_gray *gray);
/* Keeps the scaled outline of a glyph under a number, and renders it from there: the rasteriser
 * alone. */
bool peer_freetype_keep(struct peer_freetype *p, int slot, uint32_t glyph, double x_px,
                        double y_px);
bool peer_freetype_raster(struct peer_freetype *p, int slot, struct font_gray *gray);
enum { PEER_SLOTS = 128 };

struct peer_stb;
struct peer_stb *peer_stb_create(const void *bytes, double size_px);
void peer_stb_destroy(struct peer_stb *p);
bool peer_stb_draw(struct peer_stb *p, uint32_t glyph, double x_px, double y_px,
                   struct font_gray *gray);

/* Each pixel is the sum over all master pixels within the filter's reach, each with its
 * weight. */
struct peer_direct;
struct peer_direct *peer_direct_create(const struct font_filter *filter);
void peer_direct_destroy(struct peer_direct *p);
bool peer_direct_draw(struct peer_direct *p, const struct font_master *master, double size_px,
                      double x_px, double y_px, struct font_gray *gray);

#endif
