/* video.c - YUV4MPEG2 to a file, or to ffmpeg through a pipe.
 *
 * Colours go to Y'CbCr by ITU-R BT.709 in the range of 16..235 and 16..240, one chroma for each pixel (C444), as 8 bits:
 *
 *     Y' = 0.2126 R + 0.7152 G + 0.0722 B     Cb = (B - Y') / 1.8556     Cr = (R - Y') / 1.5748
 *
 * in whole numbers of 1/65536. */
#include "video.h"

#include "display_internal.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SIDE_MOST = 16384, FPS_MOST = 240, ENDING_MOST = 8 };

struct video {
    char *path, *part; /* its name in the end, and while it is written */
    int width, height;
    long frames;
    FILE *file;      /* or the pipe to ffmpeg */
    pid_t encoder;   /* 0: none, the file is written by us */
    FILE *complaint; /* what ffmpeg says */
    uint8_t *planes;
    bool failed;
};

/* ---- ffmpeg ---- */

/* Whether there is an executable of that name on the PATH. */
static bool program_is_there(const char *name)
{
    const char *path = getenv("PATH");
    char *folders = strdup(path ? path : "/usr/local/bin:/usr/bin:/bin"), *rest = folders;
    bool there = false;
    for (char *folder; folders && !there && (folder = strsep(&rest, ":"));) {
        char *file;
        if (asprintf(&file, "%s/%s", *folder ? folder : ".", name) < 0)
            break;
        there = access(file, X_OK) == 0;
        free(file);
    }
    free(folders);
    return there;
}

_Noreturn static void encoder_become(const struct video *v, int input, int fps)
{
    char rate[16];
    int nowhere = open("/dev/null", O_WRONLY);
    snprintf(rate, sizeof rate, "%d", fps);
    dup2(input, STDIN_FILENO);
    dup2(nowhere, STDOUT_FILENO);
    dup2(fileno(v->complaint), STDERR_FILENO);
    execlp("ffmpeg", "ffmpeg", "-hide_banner", "-nostdin", "-loglevel", "error", "-y", "-f",
           "yuv4mpegpipe", "-i", "pipe:0", "-r", rate, "-pix_fmt", "yuv420p", "-colorspace",
           "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", v->part, (char *)NULL);
    dprintf(STDERR_FILENO, "cannot be run: %s", strerror(errno));
    _exit(127);
}

static enum display_status encoder_start(struct video *v, int fps)
{
    int ends[2];
    v->complaint = tmpfile();
    if (!v->complaint || pipe2(ends, O_CLOEXEC) != 0)
        return display_fail(DISPLAY_IO_FAILED, "%s: cannot start ffmpeg: %s", v->path,
                            strerror(errno));
    fflush(NULL);
    v->encoder = fork();
    if (v->encoder == 0)
        encoder_become(v, ends[0], fps);
    int error = errno;
    close(ends[0]);
    v->file = v->encoder > 0 ? fdopen(ends[1], "wb") : NULL;
    if (v->file)
        return DISPLAY_OK;
    close(ends[1]);
    return display_fail(DISPLAY_IO_FAILED, "%s: cannot start ffmpeg: %s", v->path,
                        strerror(error));
}

/* Waits for it; the first line that it said, or how it ended, in `said`. False: it failed. */
static bool encoder_end(struct video *v, char said[200])
{
    int status = 0;
    snprintf(said, 200, "ffmpeg stopped");
    while (waitpid(v->encoder, &status, 0) < 0)
        if (errno != EINTR)
            return false;
    v->encoder = 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFSIGNALED(status)) {
        snprintf(said, 200, "ffmpeg was ended by signal %d (%s)", WTERMSIG(status),
                 strsignal(WTERMSIG(status)));
        return false;
    }
    char line[160] = "";
    rewind(v->complaint);
    if (!fgets(line, sizeof line, v->complaint))
        snprintf(line, sizeof line, "status %d", WEXITSTATUS(status));
    line[strcspn(line, "\r\n")] = '\0';
    snprintf(said, 200, "ffmpeg: %s", line);
    return false;
}

/* ---- life ---- */

static void video_free(struct video *v)
{
    if (v->file)
        fclose(v->file);
    if (v->encoder > 0) {
        kill(v->encoder, SIGKILL);
        while (waitpid(v->encoder, NULL, 0) < 0 && errno == EINTR)
            ;
    }
    if (v->complaint)
        fclose(v->complaint);
    if (v->part)
        unlink(v->part);
    free(v->planes);
    free(v->part);
    free(v->path);
    free(v);
}

void video_abandon(struct video *v)
{
    if (v)
        video_free(v);
}

static enum display_status io_failed(struct video *v, int error)
{
    v->failed = true;
    char said[200];
    if (v->encoder > 0) {
        if (v->file)
            fclose(v->file);
        v->file = NULL;
        encoder_end(v, said);
        return display_fail(DISPLAY_IO_FAILED, "%s: cannot write frame %ld: %s", v->path,
                            v->frames + 1, said);
    }
    return display_fail(DISPLAY_IO_FAILED, "%s: cannot write: %s", v->path, strerror(error));
}

/* film.mp4 is written as film.PID.part.mp4: ffmpeg looks at the ending. */
static bool names_make(struct video *v, const char *path, bool *ours)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    if (!dot || dot[1] == '\0' || strlen(dot) > ENDING_MOST)
        dot = path + strlen(path);
    *ours = strcmp(dot, ".y4m") == 0 || !program_is_there("ffmpeg");
    int stem = (int)(dot - path);
    if (asprintf(&v->path, "%.*s%s", stem, path, *ours ? ".y4m" : *dot ? dot : ".mp4") < 0) {
        v->path = NULL;
        return false;
    }
    if (asprintf(&v->part, "%.*s.%ld.part%s", stem, path, (long)getpid(), v->path + stem) < 0) {
        v->part = NULL;
        return false;
    }
    return true;
}

enum display_status video_create(const char *path, int width_px, int height_px, int fps,
                                 struct video **out)
{
    bool ours;
    *out = NULL;
    if (width_px < 2 || height_px < 2 || width_px > SIDE_MOST || height_px > SIDE_MOST ||
        width_px % 2 || height_px % 2 || fps < 1 || fps > FPS_MOST)
        return display_fail(DISPLAY_BAD_ARGUMENT,
                            "a video is 2..%d pixels wide and high, even, of 1..%d frames a "
                            "second (got %dx%d of %d)",
                            SIDE_MOST, FPS_MOST, width_px, height_px, fps);
    struct video *v = calloc(1, sizeof *v);
    if (!v)
        return display_fail(DISPLAY_NO_MEMORY, "no memory for a video");
    v->width = width_px;
    v->height = height_px;
    v->planes = malloc(3 * (size_t)width_px * (size_t)height_px);
    if (!v->planes || !names_make(v, path, &ours)) {
        video_free(v);
        return display_fail(DISPLAY_NO_MEMORY, "no memory for a video");
    }
    signal(SIGPIPE, SIG_IGN);
    enum display_status status = DISPLAY_OK;
    /* that the file can be made is known at once, not when ffmpeg gets there */
    int descriptor = open(v->part, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0)
        status =
            display_fail(DISPLAY_IO_FAILED, "%s: cannot write: %s", v->path, strerror(errno));
    else if (ours)
        v->file = fdopen(descriptor, "wb");
    else
        close(descriptor);
    if (status == DISPLAY_OK && !ours)
        status = encoder_start(v, fps);
    if (status == DISPLAY_OK && !v->file)
        status = display_fail(DISPLAY_NO_MEMORY, "no memory for a video");
    if (status == DISPLAY_OK && (fprintf(v->file, "YUV4MPEG2 W%d H%d F%d:1 Ip A1:1 C444\n",
                                         width_px, height_px, fps) < 0 ||
                                 fflush(v->file) != 0))
        status = io_failed(v, errno);
    if (status != DISPLAY_OK) {
        video_free(v);
        return status;
    }
    *out = v;
    return DISPLAY_OK;
}

const char *video_path(const struct video *v)
{
    return v->path;
}

long video_frames(const struct video *v)
{
    return v->frames;
}

/* ---- pictures ---- */

static void planes_fill(uint8_t *planes, const uint8_t *rgb, size_t count)
{
    uint8_t *luma = planes, *blue = planes + count, *red = planes + 2 * count;
    for (size_t i = 0; i < count; i++) {
        int r = rgb[3 * i], g = rgb[3 * i + 1], b = rgb[3 * i + 2];
        luma[i] = (uint8_t)((11966 * r + 40254 * g + 4064 * b + (16 << 16) + 32768) >> 16);
        blue[i] = (uint8_t)((-6596 * r - 22189 * g + 28785 * b + (128 << 16) + 32768) >> 16);
        red[i] = (uint8_t)((28785 * r - 26145 * g - 2640 * b + (128 << 16) + 32768) >> 16);
    }
}

enum display_status video_add(struct video *v, const uint8_t *rgb)
{
    size_t count = (size_t)v->width * (size_t)v->height;
    if (v->failed)
        return display_fail(DISPLAY_IO_FAILED, "%s: the video has failed before", v->path);
    planes_fill(v->planes, rgb, count);
    errno = 0;
    if (fputs("FRAME\n", v->file) < 0 ||
        fwrite(v->planes, 1, 3 * count, v->file) != 3 * count || fflush(v->file) != 0)
        return io_failed(v, errno ? errno : EIO);
    v->frames++;
    return DISPLAY_OK;
}

enum display_status video_finish(struct video *v)
{
    char said[200];
    enum display_status status = DISPLAY_OK;
    if (v->failed || v->frames == 0) {
        bool failed = v->failed;
        if (failed)
            status =
                display_fail(DISPLAY_IO_FAILED, "%s: the video has failed before", v->path);
        video_free(v);
        return status;
    }
    bool synced = v->encoder > 0 || fsync(fileno(v->file)) == 0 || errno == EINVAL;
    int error = errno;
    if (fclose(v->file) != 0 && synced) {
        synced = false;
        error = errno;
    }
    v->file = NULL;
    if (v->encoder > 0 && !encoder_end(v, said))
        status = display_fail(DISPLAY_IO_FAILED, "%s: cannot write: %s", v->path, said);
    else if (!synced)
        status =
            display_fail(DISPLAY_IO_FAILED, "%s: cannot write: %s", v->path, strerror(error));
    else if (rename(v->part, v->path) != 0)
        status =
            display_fail(DISPLAY_IO_FAILED, "%s: cannot write: %s", v->path, strerror(errno));
    video_free(v);
    return status;
}
