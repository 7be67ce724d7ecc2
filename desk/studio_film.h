/* studio_film.h - a sheet's history as a film of its making: each stroke grows under the ring
 * of its brush, and a line below says what is done, with which brush and which paint. What was
 * undone is left out.
 *
 *     const struct studio_film_def def = {.path = "marsh.mp4", .view = &view, .seconds_most = 60};
 *     if (studio_film_write(sheet, &def, written, sizeof written) != PAPER_OK)
 *         die(studio_session_error());
 *
 * Everything is done again on a sheet of its own, so the sheet stays as it is. Strokes take the
 * time that the hand took, steps pass as 60 a second, and other deeds are held for a moment;
 * all of it quicker, if it would take longer than it may.
 *
 * Errors: a status, and the text where studio_session_error() finds it; no file is left.
 *
 * Threads: the sheet's. */
#ifndef LUTETIA_STUDIO_FILM_H
#define LUTETIA_STUDIO_FILM_H

#include <sheet.h>

struct studio_film_def {
    const char *path; /* its ending is the format (video.h) */
    const struct paper_sheet_view *view;
    double seconds_most;
    /* told how much is done; returns false to stop. NULL: nobody */
    bool (*watch)(void *context, long done, long total);
    void *context;
};
enum { STUDIO_FILM_FPS = 30 };

/* written gets the film's name, which has another ending where ffmpeg is missing. Errors:
 * BAD_ARGUMENT (no history, or an empty one; it cannot be written; it was stopped), NO_MEMORY,
 * MACHINE_FAILED. */
enum paper_status studio_film_write(struct paper_sheet *sheet,
                                    const struct studio_film_def *def, char *written,
                                    size_t room);

#endif
