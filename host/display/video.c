/* video.c - YUV4MPEG2 to a file, or to ffmpeg through a pipe; red, green, blue (and alpha) to
 * ffmpeg where that is what the film keeps.
 *
 * Colours of YUV4MPEG2 go to Y'CbCr by ITU-R BT.709 in the range of 16..235 and 16..240, one
 * chroma for each pixel (C444), as 8 bits:
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

/* What becomes of pictures. A palette is made for each picture of its own colours, so that the
 * length of a film takes no memory. */
#define PALETTE "[0:v]split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1[v]"
#define BT709 "[0:v]scale=out_color_matrix=bt709:out_range=tv,format="
#define BT709_SAID "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"
/* clang-format off */
static const char *const palette[] = {"-filter_complex", PALETTE, "-map", "[v]", NULL};
static const char *const usual[] = {"-map", "0:v", "-pix_fmt", "yuv420p", BT709_SAID, NULL};
static const char *const ffv1[] = {"-map", "0:v", "-c:v", "ffv1", "-pix_fmt", "bgra", NULL};
static const char *const prores[] = {"-filter_complex", BT709 "yuva444p10le[v]", "-map", "[v]",
    "-c:v", "prores_ks", "-profile:v", "4444", BT709_SAID, NULL};
static const char *const vp9[] = {"-filter_complex", BT709 "yuva420p[v]", "-map", "[v]",
    "-c:v", "libvpx-vp9", "-auto-alt-ref", "0" /* which alpha wants */, "-b:v", "0",
    "-crf", "20", BT709_SAID, NULL};
/* clang-format on */

/* The endings of names, with ffmpeg's name of the container; NULL: written by us. */
static const struct container {
    const char *ending, *format;
    bool sounds; /* it can hold sound */
    /* each picture is in it, at whatever rate: a .gif's times are hundredths of a second */
    bool counts;
    const char *const *words; /* of ffmpeg's command line: how it is encoded */
    const char *const *alpha; /* the same with alpha; NULL: it holds none */
} containers[] = {
    {".mp4", "mp4", true, true, usual, NULL},
    {".m4v", "mp4", true, true, usual, NULL},
    {".mkv", "matroska", true, true, usual, ffv1},
    {".webm", "webm", true, true, usual, vp9},
    {".mov", "mov", true, true, usual, prores},
    {".avi", "avi", true, true, usual, NULL},
    {".ogv", "ogg", true, false, usual, NULL},
    {".gif", "gif", false, false, palette, palette},
    {".y4m", NULL, false, false, NULL, NULL},
};
enum { CONTAINERS = sizeof containers / sizeof *containers, OURS = CONTAINERS - 1 };

struct video {
    char *path; /* the file's final name */
    struct output_file out;
    const struct container *container;
    int width, height, fps;
    int sound; /* a descriptor of a WAV file; -1: it is silent */
    bool alpha;
    bool later; /* sound comes at the end */
    bool raw;   /* pictures go to ffmpeg as they are */
    long frames;
    FILE *file;      /* out's stream, or the pipe to ffmpeg */
    pid_t encoder;   /* 0: no ffmpeg, the file is written by us */
    FILE *complaint; /* ffmpeg's messages */
    /* what ffmpeg writes where sound comes later; has no name. NULL: it writes to `out` */
    FILE *pictures;
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

/* Adds words to a list that ends with NULL, and has room. */
static void words_add(char **words, const char *const *more)
{
    while (*words)
        words++;
    while (*more)
        *words++ = (char *)(uintptr_t)*more++;
}

/* ffmpeg gets no file name. It reads from a pipe and writes, in a given format, to a
 * descriptor of ours through /proc or /dev/fd. So nothing in a film's name can act as an
 * option, a pattern or a protocol. */
_Noreturn static void encoder_become(const struct video *v, int input, int fps)
{
    enum { OUTPUT = 3, SOUND = 4, WORDS_MAX = 64 };
    char rate[16], size[32], output[32], sound[32];
    char *words[WORDS_MAX] = {NULL}; /* which execvp() does not change */
    int nowhere = streams_nowhere(O_WRONLY), complaint = dup(fileno(v->complaint)),
        file = dup(fileno(v->pictures ? v->pictures : v->out.stream)),
        wav = v->sound >= 0 ? dup(v->sound) : -1;
    snprintf(rate, sizeof rate, "%d", fps);
    snprintf(size, sizeof size, "%dx%d", v->width, v->height);
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
                                 v->raw ? "rawvideo" : "yuv4mpegpipe",
                                 NULL};
    const char *const raw[] = {"-pixel_format",
                               v->alpha ? "rgba" : "rgb24",
                               "-video_size",
                               size,
                               "-framerate",
                               rate,
                               NULL};
    const char *const pictures[] = {"-i", "pipe:0", NULL};
    const char *const heard[] = {"-protocol_whitelist", "file", "-f", "wav", "-i", sound, NULL};
    /* A film ends with its pictures, also an interrupted one: silence follows the sound, and
     * the shorter of both is then the pictures. */
    const char *const hears[] = {"-map", "1:a", "-af", "apad", "-shortest", NULL};
    const char *const end[] = {"-r", rate, "-f", v->container->format, output, NULL};
    words_add(words, begin);
    if (v->raw)
        words_add(words, raw);
    words_add(words, pictures);
    if (wav >= 0)
        words_add(words, heard);
    words_add(words, v->alpha ? v->container->alpha : v->container->words);
    if (wav >= 0)
        words_add(words, hears);
    words_add(words, end);
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
    const bool apart = v->later && v->container->sounds;
    if (apart)
        v->pictures = tmpfile();
    if (!v->complaint || (apart && !v->pictures) || pipe2(ends, O_CLOEXEC) != 0)
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

/* Puts the pictures' film and the sound (-1: none) together: nothing is encoded again but the
 * sound. */
_Noreturn static void joiner_become(const struct video *v, int sound)
{
    enum { OUTPUT = 3, PICTURES = 4, SOUND = 5, FREE = 10, WORDS_MAX = 40 };
    char *words[WORDS_MAX] = {NULL};
    const char *const format = v->container->format;
    const char *const begin[] = {
        "ffmpeg", "-hide_banner",        "-nostdin", "-loglevel", "error",
        "-y",     "-protocol_whitelist", "file",     "-f",        format,
        "-i",     "/proc/self/fd/4",     NULL};
    const char *const heard[] = {"-protocol_whitelist", "file", "-f", "wav", "-i",
                                 "/proc/self/fd/5",     NULL};
    const char *const pictures[] = {"-map", "0:v", "-c:v", "copy", NULL};
    const char *const hears[] = {"-map", "1:a", NULL};
    const char *const end[] = {"-f", format, "/proc/self/fd/3", NULL};
    const int from[] = {streams_nowhere(O_RDONLY), streams_nowhere(O_WRONLY),
                        fileno(v->complaint),      fileno(v->out.stream),
                        fileno(v->pictures),       sound};
    int kept[SOUND + 1];
    words_add(words, begin);
    if (sound >= 0)
        words_add(words, heard);
    words_add(words, pictures);
    if (sound >= 0)
        words_add(words, hears);
    words_add(words, end);
    for (int i = 0; i <= SOUND; i++) /* first out of each other's way */
        kept[i] = from[i] >= 0 ? fcntl(from[i], F_DUPFD_CLOEXEC, FREE) : -1;
    for (int i = 0; i <= SOUND; i++)
        if (kept[i] >= 0)
            dup2(kept[i], i);
    execvp("ffmpeg", words);
    dprintf(STDERR_FILENO, "cannot be run: %s", strerror(errno));
    _exit(127);
}

/* False: said why not. */
static bool film_join(struct video *v, int sound, char said[200])
{
    fflush(NULL);
    v->encoder = fork();
    if (v->encoder == 0)
        joiner_become(v, sound);
    if (v->encoder < 0) {
        v->encoder = 0;
        snprintf(said, 200, "cannot start ffmpeg: %s", strerror(errno));
        return false;
    }
    return encoder_end(v, said);
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
    if (v->pictures)
        fclose(v->pictures);
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

/* Where a name's ending begins; its end, if it has none. */
static const char *ending_find(const char *path)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    return dot ? dot : path + strlen(path);
}

/* NULL: there is none with such an ending. */
static const struct container *container_find(const char *path)
{
    const char *dot = ending_find(path);
    for (int i = 0; i < CONTAINERS; i++)
        if (strcasecmp(*dot ? dot : ".mp4", containers[i].ending) == 0)
            return &containers[i];
    return NULL;
}

/* The name's ending selects the format; a name without one gets .mp4. Without ffmpeg the
 * ending becomes .y4m. */
static enum display_status name_make(struct video *v, const char *path)
{
    const char *dot = ending_find(path);
    v->container = container_find(path);
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
    if (!v->raw && (fprintf(v->file, "YUV4MPEG2 W%d H%d F%d:1 Ip A1:1 C444\n", v->width,
                            v->height, fps) < 0 ||
                    fflush(v->file) != 0))
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
    return video_create_as(&(struct video_def){.path = path,
                                               .width_px = width_px,
                                               .height_px = height_px,
                                               .fps = fps,
                                               .sound = sound},
                           out);
}

static enum display_status video_make(struct video *v, const struct video_def *def)
{
    enum display_status status = name_make(v, def->path);
    if (status != DISPLAY_OK)
        return status;
    if (def->alpha && !v->container->alpha)
        return display_fail(DISPLAY_BAD_ARGUMENT,
                            "%s: such a film holds no transparency; .mov, .mkv, .webm and "
                            ".gif do",
                            v->path);
    v->raw = def->alpha || v->container->words == palette;
    if (def->sound >= 0 && v->container->sounds) {
        v->sound = fcntl(def->sound, F_DUPFD_CLOEXEC, 0);
        if (v->sound < 0)
            return display_fail(DISPLAY_IO_FAILED, "%s: the sound: %s", def->path,
                                strerror(errno));
    }
    if (!(v->planes = malloc(3 * (size_t)v->width * (size_t)v->height)))
        return display_fail(DISPLAY_NO_MEMORY, "no memory for a video");
    return video_open(v, v->fps);
}

enum display_status video_create_as(const struct video_def *def, struct video **out)
{
    const int width = def->width_px, height = def->height_px;
    *out = NULL;
    if (width < 2 || height < 2 || width > SIDE_MOST || height > SIDE_MOST || width % 2 ||
        height % 2 || def->fps < 1 || def->fps > FPS_MOST)
        return display_fail(DISPLAY_BAD_ARGUMENT,
                            "a video is 2..%d pixels wide and high, even, of 1..%d frames a "
                            "second (got %dx%d of %d)",
                            SIDE_MOST, FPS_MOST, width, height, def->fps);
    struct video *v = calloc(1, sizeof *v);
    if (!v)
        return display_fail(DISPLAY_NO_MEMORY, "no memory for a video");
    v->width = width;
    v->height = height;
    v->fps = def->fps;
    v->sound = -1;
    v->alpha = def->alpha;
    v->later = def->sounds_later;
    enum display_status status = video_make(v, def);
    if (status != DISPLAY_OK) {
        video_free(v);
        return status;
    }
    *out = v;
    return DISPLAY_OK;
}

bool video_alpha(const char *path)
{
    const struct container *c = container_find(path);
    return c && c->alpha && program_is_there("ffmpeg");
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
    const size_t count = (size_t)v->width * (size_t)v->height,
                 bytes = (v->alpha ? 4 : 3) * count;
    if (v->failed)
        return display_fail(DISPLAY_IO_FAILED, "%s: the video has failed before", v->path);
    if (!v->raw)
        planes_fill(v->planes, rgb, count);
    errno = 0;
    if ((!v->raw && fputs("FRAME\n", v->file) < 0) ||
        fwrite(v->raw ? rgb : v->planes, 1, bytes, v->file) != bytes || fflush(v->file) != 0)
        return io_failed(v, errno ? errno : EIO);
    v->frames++;
    return DISPLAY_OK;
}

/* A full disk is the likely reason: what can be written now says so. */
static bool film_is_whole(const struct video *v, bool sounds, char said[200])
{
    const struct video_held held = {
        .format = v->container->format,
        .frames = v->frames,
        .exactly = v->container->counts || (v->fps <= GIF_FPS_MOST && !v->container->sounds),
        .sounds = sounds};
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
    return video_finish_with_sound(v, -1);
}

enum display_status video_finish_with_sound(struct video *v, int sound)
{
    char said[200];
    bool sounds = v->sound >= 0;
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
        if (encoded && !error && v->pictures) {
            encoded = film_join(v, sound, said);
            sounds = sound >= 0;
        }
        if (encoded && !error)
            encoded = film_is_whole(v, sounds, said);
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
