/* text_pango.h - the same text set by Pango, for `lutetia bench text` and `reader`, if Pango
 * was available at build time.
 *
 *     struct peer_pango *p = peer_pango_create("DejaVu Sans", 12, 400);
 *     int lines = peer_pango_layout(p, text, bytes);     // set anew each time
 *     peer_pango_destroy(p);
 */
#ifndef LUTETIA_BENCH_TEXT_PANGO_H
#define LUTETIA_BENCH_TEXT_PANGO_H

#include <stddef.h>

struct peer_pango;
/* NULL: no memory, or no Pango. */
struct peer_pango *peer_pango_create(const char *family, double size_px, double width_px);
void peer_pango_destroy(struct peer_pango *p); /* NULL is fine */
/* Another font, size and width, from the next text on. */
void peer_pango_set(struct peer_pango *p, const char *family, double size_px, double width_px);
/* Justified lines; returns how many. */
int peer_pango_layout(struct peer_pango *p, const char *text, size_t bytes);
/* The same, and its layout, which takes memory until it is released. */
int peer_pango_keep(struct peer_pango *p, const char *text, size_t bytes, void **kept);
void peer_pango_release(void *kept); /* NULL is fine */

#endif
