/* video.h - writes pictures as a film: MP4, Matroska, WebM, QuickTime, AVI, Ogg and GIF by
 * ffmpeg, where it is installed, and YUV4MPEG2 (.y4m) without it.
 *
 *     struct video *video;
 *     if (video_create("film.mp4", 640, 480, 30, &video) != DISPLAY_OK)
 *         die(display_error());
 *     for (...)
 *         if (video_add(video, rgb) != DISPLAY_OK)
 *             die(display_error());
 *     if (video_finish(video) != DISPLAY_OK)
 *         die(display_error());
 *
 * The film is written to a part file first (output_file.h); video_finish() renames it. ffmpeg
 * never sees the name. The name's ending selects the format (.mp4 .m4v .mkv .webm .mov .avi
 * .ogv .gif .y4m; none: .mp4); where ffmpeg is missing, film.mp4 becomes film.y4m (video_path()
 * returns the name), which most players and encoders read.
 *
 * Errors and threads: as display.h says; SIGPIPE is ignored from the first video on.
 */
#ifndef LUTETIA_DISPLAY_VIDEO_H
#define LUTETIA_DISPLAY_VIDEO_H

#include "display.h"

#include <stdbool.h>

struct video;

/* Width and height: even, 2 to 16384. `fps` 1 to 240. Errors: BAD_ARGUMENT, IO_FAILED,
 * NO_MEMORY; *out is then NULL. Owns: the caller ends it by video_finish() or
 * video_abandon(). */
enum display_status video_create(const char *path, int width_px, int height_px, int fps,
                                 struct video **out);
/* The same with sound: `sound` is a descriptor of a whole WAV file, which is read from its
 * beginning while the video is made; -1: none. The caller may close it at once. Pictures and
 * sound begin together. */
enum display_status video_create_with_sound(const char *path, int width_px, int height_px,
                                            int fps, int sound, struct video **out);
/* All that a film can have. */
struct video_def {
    const char *path;
    int width_px, height_px, fps;
    int sound;         /* a descriptor, as above; -1: none */
    bool sounds_later; /* sound may come with video_finish_with_sound(); then `sound` is -1 */
    /* pictures have four channels, and the film keeps the fourth: .mov as ProRes 4444, .mkv as
     * FFV1, .webm as VP9, .gif as opaque or clear */
    bool alpha;
};
/* Errors: those of video_create(); BAD_ARGUMENT: such a film holds no alpha. */
enum display_status video_create_as(const struct video_def *def, struct video **out);
/* Whether a film of that name can have alpha, here. */
bool video_alpha(const char *path);

/* Whether the film can hold sound: .gif and .y4m cannot. */
bool video_sounds(const struct video *video);
/* Adds a picture. Shape: height * width * 3 bytes of display values, 4 with alpha (by which
 * colours are not multiplied). Errors: IO_FAILED (a full disk; ffmpeg failed or was killed:
 * what it said). */
enum display_status video_add(struct video *video, const uint8_t *rgb);
/* Ends the film and renames it; a film without pictures leaves no file. Frees the video,
 * also on failure; then no file is left. Errors: IO_FAILED. */
enum display_status video_finish(struct video *video);
/* The same for a video that was made with sounds_later. sound: a descriptor of a whole WAV
 * file; -1, or a format without sound: the film is silent. The caller closes it. */
enum display_status video_finish_with_sound(struct video *video, int sound);
/* Removes the part file and frees the video. NULL is fine. */
void video_abandon(struct video *video);

/* The film's final name. Owns: the video. */
const char *video_path(const struct video *video);
long video_frames(const struct video *video);

#endif
