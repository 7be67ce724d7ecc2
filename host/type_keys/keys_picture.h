/* keys_picture.h - pictures of moments of letters that keys play.
 *
 * A moment has all keys that are played, the lowest at the left, on one baseline, each as
 * large as it sounds. A channel has an ink of its own. A poster is in keys_poster.h.
 */
#ifndef LUTETIA_KEYS_PICTURE_H
#define LUTETIA_KEYS_PICTURE_H

#include "keys_letters.h"

#include <paint.h>

enum { KEYS_INKS = MIDI_CHANNELS };

struct keys_type_def {
    const char *filter;
    double size_px[2];                   /* of the em: least and most */
    double step_px;                      /* on a poster: from key to key, upwards */
    double inks[KEYS_INKS][3], paper[3]; /* sRGB, 0..1 */
};
struct keys_type_def keys_type_def_default(void);

struct keys_type;

/* All are borrowed and must outlive *out. Errors: those of shapers and painters; NO_MEMORY. */
enum font_status keys_type_create(const struct keys_type_def *def, struct font_face *face,
                                  const struct keys_score *score,
                                  const struct keys_letters *letters, struct keys_type **out);
void keys_type_destroy(struct keys_type *type); /* NULL is fine */

/* Fills the picture with paper. */
void keys_type_paper(const struct keys_type *type, struct font_picture *picture);
enum font_status keys_type_moment(struct keys_type *type, double time_s,
                                  struct font_picture *picture);
/* The largest size at which all moments fit a picture. Errors: those of shapers. */
enum font_status keys_type_fit(struct font_face *face, const struct keys_score *score,
                               const struct keys_letters *letters, int width_px, int height_px,
                               double *size_px);

#endif
