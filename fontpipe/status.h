/* status.h - what can go wrong in the font pipeline.
 *
 *     if (font_face_open("DejaVuSans.ttf", 0, &face) != FONT_OK)
 *         die(font_error());
 *
 * Errors: a function that can fail returns a status; font_error() then has one line: what is
 * wrong, and where.
 *
 * Ownership: the message is the library's. Threads: any; the message belongs to the thread that
 * failed. */
#ifndef LUTETIA_FONT_STATUS_H
#define LUTETIA_FONT_STATUS_H

enum font_status {
    FONT_OK = 0,
    FONT_BAD_ARGUMENT,  /* a size, number or name that cannot be */
    FONT_BAD_FILE,      /* not a font, or a damaged one */
    FONT_NO_GLYPH,      /* the font has no such glyph, or no outline for it */
    FONT_TOO_LARGE,     /* a picture or an outline beyond the library's limits */
    FONT_NO_MEMORY,     /* or the work shall stop: patience.h */
    FONT_NO_DEVICE,     /* no OpenCL device that fits the choice */
    FONT_DEVICE_FAILED, /* the device's reason is in font_error() */
    FONT_FULL           /* an atlas: all of it is in use */
};

/* Detail of this thread's last failure, one line; "" if there was none, never NULL.
 * Owns: the library; valid until this thread's next failure. */
const char *font_error(void);

/* One line that names a glyph which was left out of this thread's pictures since this was last
 * asked, because its outline cannot be read, and says how many there are; NULL: none was. Of
 * many glyphs some may be counted more than once. Owns: the library; valid until this thread
 * asks again. */
const char *font_left_out(void);

#endif
