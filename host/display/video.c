/* video.c - YUV4MPEG2 to a file, or to ffmpeg through a pipe.
 *
 * Colours go to Y'CbCr by ITU-R BT.709 in the range of 16..235 and 16..240, one chroma for each pixel (C444), as 8 bits:
 *
 *     Y' = 0.2126 R + 0.7152 G + 0.0722 B     Cb = (B - Y') / 1.8556     Cr = (R - Y') / 1.5748
 *
 * in whole numbers of 1/65536. */
#include "video.h"

#include "display_internal.h"
#include "video_check.h"

#include <output_file.h>
#include <streams.h>

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SIDE_MOST = 16384, FPS_MOST = 240, GIF_FPS_MOST = 50 };

/* The endings of names, with ffmpeg's name of the container; NULL: written by us. */
static const struct container {
    const char *ending, *format;
    bool sounds; /* it can hold sound */
    bool
        counts; /* each picture is in it, at whatever rate: a .gif's times are hundredths of a second */
} containers[] = {
    {".mp4", "mp4", true, true},      {".m4v", "mp4", true, true},
    {".mkv", "matroska", true, true}, {".webm", "webm", true, true},
    {".mov", "mov", true, true},      {".avi", "avi", true, true},
    {".ogv", "ogg", true, false},     {".gif", "gif", false, false},
    {".y4m", NULL, false, false},
};
enum { CONTAINERS = sizeof containers / sizeof *containers, OURS = CONTAINERS - 1 };

struct video {
    char *path; /* the file's final name */
    struct output_file out;
    const struct container *container;
    int width, height, fps;
    int sound; /* a descriptor of a WAV file; -1: it is silent */
    long frames;
    FILE *file;      /* out's stream, or the pipe to ffmpeg */
    pid_t encoder;   /* 0: no ffmpeg, the file is written by us */
    FILE *complaint; /* ffmpeg's messages */
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

/* ffmpeg gets no file name. It reads from a pipe and writes, in a given format, to a
 * descriptor of ours through /proc or /dev/fd. So nothing in a film's name can act as an
 * option, a pattern or a protocol. */
_Noreturn static void encoder_become(const struct video *v, int input, int fps)
{
    enum { OUTPUT = 3, SOUND = 4, WORDS_MAX = 48 };
    char rate[16], output[32], sound[32];
    char *words[WORDS_MAX]; /* which execvp() does not change */
    int count = 0;
    int nowhere = streams_nowhere(O_WRONLY), complaint = dup(fileno(v->complaint)),
        file = dup(fileno(v->out.stream)), wav = v->sound >= 0 ? dup(v->sound) : -1;
    snprintf(rate, sizeof rate, "%d", fps);
    snprintf(output, sizeof output, "/proc/self/fd/%d", OUTPUT);
    snprintf(sound, sizeof sound, "/proc/self/fd/%d", SOUND);
    const char *const begin[] = {"ffmpeg",
                                 "-hide_banner",
                                 "-nostdin",
                                 "-loglevel",
                                 "error",
                                 "-y",
                                 "-protocol_whitelist",
                                 "pipe,file",
                                 "-f",
                                 "yuv4mpegpipe",
                                 "-i",
                                 "pipe:0"};
    const char *const sounding[] = {
        "-protocol_whitelist", "file", "-f", "wav", "-i", sound, "-map", "0:v", "-map", "1:a"};
    const char *const end[] = {"-r",
                               rate,
                               "-pix_fmt",
                               "yuv420p",
                               "-colorspace",
                               "bt709",
                               "-color_primaries",
                               "bt709",
                               "-color_trc",
                               "bt709",
                               "-f",
                               v->container->format,
                               output};
    for (size_t i = 0; i < sizeof begin / sizeof *begin; i++)
        words[count++] = (char *)(uintptr_t)begin[i];
    for (size_t i = 0; wav >= 0 && i < sizeof sounding / sizeof *sounding; i++)
        words[count++] = (char *)(uintptr_t)sounding[i];
    for (size_t i = 0; i < sizeof end / sizeof *end; i++)
        words[count++] = (char *)(uintptr_t)end[i];
    words[count] = NULL;
    dup2(input, STDIN_FILENO);
    dup2(nowhere, STDOUT_FILENO);
    dup2(complaint, STDERR_FILENO);
    dup2(file, OUTPUT);
    if (wav >= 0)
        dup2(wav, SOUND);
    execvp("ffmpeg", words);
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

/* Waits for ffmpeg; `said` gets its last line, or how it ended. False: ffmpeg failed. */
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
    for (char more[sizeof line]; fgets(more, sizeof more, v->complaint);)
        if (*more != '\n')
            memcpy(line, more, sizeof line);
    if (!*line)
        snprintf(line, sizeof line, "status %d", WEXITSTATUS(status));
    line[strcspn(line, "\r\n")] = '\0';
    snprintf(said, 200, "ffmpeg: %s", line);
    return false;
}

/* ---- life ---- */

static void video_free(struct video *v)
{
    if (v->file && v->file != v->out.stream)
        fclose(v->file);
    if (v->encoder > 0) {
        kill(v->encoder, SIGKILL);
        while (waitpid(v->encoder, NULL, 0) < 0 && errno == EINTR)
            ;
    }
    if (v->complaint)
        fclose(v->complaint);
    output_file_abandon(&v->out);
    if (v->sound >= 0)
        close(v->sound);
    free(v->planes);
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

/* The name's ending selects the format; a name without one gets .mp4. Without ffmpeg the
 * ending becomes .y4m. */
static enum display_status name_make(struct video *v, const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    if (!dot)
        dot = path + strlen(path);
    for (int i = 0; i < CONTAINERS && !v->container; i++)
        if (strcasecmp(*dot ? dot : ".mp4", containers[i].ending) == 0)
            v->container = &containers[i];
    if (!v->container) {
        char known[100] = "";
        for (int i = 0; i < CONTAINERS; i++)
            snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", i ? ", " : "",
                     containers[i].ending);
        return display_fail(DISPLAY_BAD_ARGUMENT, "%s: a video's name ends with one of %s",
                            path, known);
    }
    bool as_it_is = *dot && !v->container->format;
    if (!program_is_there("ffmpeg"))
        v->container = &containers[OURS];
    const char *ending =
        as_it_is || (*dot && v->container->format) ? dot : v->container->ending;
    if (asprintf(&v->path, "%.*s%s", (int)(dot - path), path, ending) >= 0)
        return DISPLAY_OK;
    v->path = NULL;
    return display_fail(DISPLAY_NO_MEMORY, "no memory for a video");
}

/* The file is made at once, so that a failure is known before ffmpeg starts writing. */
static enum display_status video_open(struct video *v, int fps)
{
    signal(SIGPIPE, SIG_IGN);
    if (!output_file_open(&v->out, v->path))
        return display_fail(DISPLAY_IO_FAILED, "%s: cannot write: %s", v->path, v->out.why);
    v->file = v->out.stream;
    if (v->container->format) {
        v->file = NULL;
        enum display_status status = encoder_start(v, fps);
        if (status != DISPLAY_OK)
            return status;
    }
    if (fprintf(v->file, "YUV4MPEG2 W%d H%d F%d:1 Ip A1:1 C444\n", v->width, v->height, fps) <
            0 ||
        fflush(v->file) != 0)
        return io_failed(v, errno);
    return DISPLAY_OK;
}

enum display_status video_create(const char *path, int width_px, int height_px, int fps,
                                 struct video **out)
{
    return video_create_with_sound(path, width_px, height_px, fps, -1, out);
}

enum display_status video_create_with_sound(const char *path, int width_px, int height_px,
                                            int fps, int sound, struct video **out)
{
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
    v->fps = fps;
    v->sound = -1;
    enum display_status status = name_make(v, path);
    if (status == DISPLAY_OK && sound >= 0 && v->container->sounds) {
        v->sound = fcntl(sound, F_DUPFD_CLOEXEC, 0);
        if (v->sound < 0)
            status =
                display_fail(DISPLAY_IO_FAILED, "%s: the sound: %s", path, strerror(errno));
    }
    if (status == DISPLAY_OK && !(v->planes = malloc(3 * (size_t)width_px * (size_t)height_px)))
        status = display_fail(DISPLAY_NO_MEMORY, "no memory for a video");
    if (status == DISPLAY_OK)
        status = video_open(v, fps);
    if (status != DISPLAY_OK) {
        video_free(v);
        return status;
    }
    *out = v;
    return DISPLAY_OK;
}

bool video_sounds(const struct video *v)
{
    return v->sound >= 0;
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

/* A full disk is the likely reason: what can be written now says so. */
static bool film_is_whole(const struct video *v, char said[200])
{
    const struct video_held held = {
        .format = v->container->format,
        .frames = v->frames,
        .exactly = v->container->counts || (v->fps <= GIF_FPS_MOST && !v->container->sounds),
        .sounds = v->sound >= 0};
    const int file = fileno(v->out.stream);
    char wrong[150];
    if (video_read_back(file, &held, wrong, sizeof wrong))
        return true;
    const off_t end = lseek(file, 0, SEEK_END);
    static const uint8_t more[1 << 16];
    errno = 0;
    const bool full = end >= 0 && pwrite(file, more, sizeof more, end) != sizeof more && errno;
    snprintf(said, 200, "%s", full ? output_file_explain(errno) : wrong);
    return false;
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
    if (v->encoder > 0) {
        int error = fclose(v->file) == 0 ? 0 : errno;
        v->file = NULL;
        bool encoded = encoder_end(v, said);
        if (encoded && !error)
            encoded = film_is_whole(v, said);
        if (!encoded || error) {
            status = display_fail(DISPLAY_IO_FAILED, "%s: cannot write: %s", v->path,
                                  encoded ? output_file_explain(error) : said);
            video_free(v);
            return status;
        }
    }
    v->file = NULL;
    if (!output_file_commit(&v->out))
        status = display_fail(DISPLAY_IO_FAILED, "%s: cannot write: %s", v->path, v->out.why);
    video_free(v);
    return status;
}
