/* picture_stream_pipewire.c - pictures to PipeWire: a source of video, to which any program
 * links itself, or a session manager links it. The library is loaded when a stream is opened.
 *
 * The stream drives its graph: each picture starts a cycle. Where it does not (a reader with
 * another driver), the graph asks for a picture, and gets the last one. Callbacks run in the
 * library's thread, under its lock, which the stream's thread takes, too. */
#include "picture_stream_internal.h"

#include <library.h>

#include <pipewire/pipewire.h>
#include <spa/param/video/format-utils.h>
#include <spa/pod/builder.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { START_S = 3, BUFFERS_LEAST = 2, BUFFERS = 4, BUFFERS_MOST = 16, POD_BYTES = 1024 };

/* clang-format off */
#define PW_NAMES(X)                                                                            \
    X(pw_init) X(pw_properties_new)                                                            \
    X(pw_thread_loop_new) X(pw_thread_loop_destroy) X(pw_thread_loop_get_loop)                 \
    X(pw_thread_loop_start) X(pw_thread_loop_stop) X(pw_thread_loop_lock)                      \
    X(pw_thread_loop_unlock) X(pw_thread_loop_signal) X(pw_thread_loop_timed_wait)             \
    X(pw_stream_new_simple) X(pw_stream_destroy) X(pw_stream_connect)                          \
    X(pw_stream_update_params) X(pw_stream_dequeue_buffer) X(pw_stream_queue_buffer)           \
    X(pw_stream_is_driving) X(pw_stream_trigger_process)
/* clang-format on */

#define PW_MEMBER(name) __typeof__(name) *name;
static struct {
    PW_NAMES(PW_MEMBER)
} pw;

#define PW_ROW(name) LIBRARY_FUNCTION(pw, name),
static const struct library_function functions[] = {PW_NAMES(PW_ROW)};

struct pipe {
    struct picture_stream_def def;
    struct pw_thread_loop *loop;
    struct pw_stream *stream;
    /* under the loop's lock */
    enum spa_video_format format; /* what its reader takes; UNKNOWN: there is none */
    bool up, failed, has_picture, streaming;
    char why[200];
    uint8_t *rgba; /* the last picture */
    uint64_t number;
};

static size_t row_bytes(const struct pipe *p)
{
    return 4 * (size_t)p->def.width_px;
}

static size_t picture_bytes(const struct pipe *p)
{
    return row_bytes(p) * (size_t)p->def.height_px;
}

/* ---- what the library calls ---- */

static void state_changed(void *context, enum pw_stream_state old, enum pw_stream_state state,
                          const char *error)
{
    struct pipe *p = context;
    (void)old;
    p->streaming = state == PW_STREAM_STATE_STREAMING;
    p->up = p->up || state == PW_STREAM_STATE_PAUSED || p->streaming;
    if (state == PW_STREAM_STATE_ERROR || (p->up && state == PW_STREAM_STATE_UNCONNECTED)) {
        p->failed = true;
        snprintf(p->why, sizeof p->why, "PipeWire: %.150s",
                 error ? error : "the connection is lost");
    }
    pw.pw_thread_loop_signal(p->loop, false);
}

static void param_changed(void *context, uint32_t id, const struct spa_pod *param)
{
    struct pipe *p = context;
    struct spa_video_info_raw info = {0};
    uint8_t bytes[POD_BYTES];
    struct spa_pod_builder b = SPA_POD_BUILDER_INIT(bytes, sizeof bytes);
    if (id != SPA_PARAM_Format)
        return;
    p->format = SPA_VIDEO_FORMAT_UNKNOWN;
    if (!param || spa_format_video_raw_parse(param, &info) < 0)
        return;
    p->format = info.format;
    const struct spa_pod *params[2];
    params[0] = spa_pod_builder_add_object(
        &b, SPA_TYPE_OBJECT_ParamBuffers, SPA_PARAM_Buffers, SPA_PARAM_BUFFERS_buffers,
        SPA_POD_CHOICE_RANGE_Int(BUFFERS, BUFFERS_LEAST, BUFFERS_MOST),
        SPA_PARAM_BUFFERS_blocks, SPA_POD_Int(1), SPA_PARAM_BUFFERS_size,
        SPA_POD_Int((int)picture_bytes(p)), SPA_PARAM_BUFFERS_stride,
        SPA_POD_Int((int)row_bytes(p)), SPA_PARAM_BUFFERS_dataType,
        SPA_POD_CHOICE_FLAGS_Int(1 << SPA_DATA_MemFd | 1 << SPA_DATA_MemPtr));
    params[1] = spa_pod_builder_add_object(&b, SPA_TYPE_OBJECT_ParamMeta, SPA_PARAM_Meta,
                                           SPA_PARAM_META_type, SPA_POD_Id(SPA_META_Header),
                                           SPA_PARAM_META_size,
                                           SPA_POD_Int((int)sizeof(struct spa_meta_header)));
    pw.pw_stream_update_params(p->stream, params, 2);
}

static void picture_copy(const struct pipe *p, uint8_t *out)
{
    const size_t count = picture_bytes(p);
    if (p->format == SPA_VIDEO_FORMAT_RGBA || p->format == SPA_VIDEO_FORMAT_RGBx) {
        memcpy(out, p->rgba, count);
        return;
    }
    for (size_t i = 0; i < count; i += 4) {
        out[i] = p->rgba[i + 2];
        out[i + 1] = p->rgba[i + 1];
        out[i + 2] = p->rgba[i];
        out[i + 3] = p->rgba[i + 3];
    }
}

static void process(void *context)
{
    struct pipe *p = context;
    struct pw_buffer *buffer = pw.pw_stream_dequeue_buffer(p->stream);
    if (!buffer)
        return; /* the reader has all of them still */
    struct spa_data *data = &buffer->buffer->datas[0];
    const bool fits = p->has_picture && p->format != SPA_VIDEO_FORMAT_UNKNOWN && data->data &&
                      data->maxsize >= picture_bytes(p);
    if (fits)
        picture_copy(p, data->data);
    data->chunk->offset = 0;
    data->chunk->stride = (int32_t)row_bytes(p);
    data->chunk->size = fits ? (uint32_t)picture_bytes(p) : 0;
    struct spa_meta_header *head =
        spa_buffer_find_meta_data(buffer->buffer, SPA_META_Header, sizeof *head);
    if (head) {
        struct timespec now;
        clock_gettime(CLOCK_MONOTONIC, &now);
        *head = (struct spa_meta_header){.flags = fits ? 0 : SPA_META_HEADER_FLAG_CORRUPTED,
                                         .pts = now.tv_sec * SPA_NSEC_PER_SEC + now.tv_nsec,
                                         .seq = p->number};
    }
    p->number++;
    pw.pw_stream_queue_buffer(p->stream, buffer);
}

static const struct pw_stream_events events = {
    PW_VERSION_STREAM_EVENTS,
    .state_changed = state_changed,
    .param_changed = param_changed,
    .process = process,
};

/* ---- a stream ---- */

static void pipe_close(void *own)
{
    struct pipe *p = own;
    if (p->loop)
        pw.pw_thread_loop_stop(p->loop);
    if (p->stream)
        pw.pw_stream_destroy(p->stream);
    if (p->loop)
        pw.pw_thread_loop_destroy(p->loop);
    free(p->rgba);
    free(p);
}

/* Offers the size, the rate, and two orders of colours. */
static int stream_connect(struct pipe *p)
{
    uint8_t bytes[POD_BYTES];
    struct spa_pod_builder b = SPA_POD_BUILDER_INIT(bytes, sizeof bytes);
    const uint32_t first = p->def.alpha ? SPA_VIDEO_FORMAT_BGRA : SPA_VIDEO_FORMAT_BGRx,
                   second = p->def.alpha ? SPA_VIDEO_FORMAT_RGBA : SPA_VIDEO_FORMAT_RGBx;
    const struct spa_rectangle size = {(uint32_t)p->def.width_px, (uint32_t)p->def.height_px};
    const struct spa_fraction rate = {(uint32_t)lround(1000 * p->def.fps), 1000};
    const struct spa_pod *params[1];
    params[0] = spa_pod_builder_add_object(
        &b, SPA_TYPE_OBJECT_Format, SPA_PARAM_EnumFormat, SPA_FORMAT_mediaType,
        SPA_POD_Id(SPA_MEDIA_TYPE_video), SPA_FORMAT_mediaSubtype,
        SPA_POD_Id(SPA_MEDIA_SUBTYPE_raw), SPA_FORMAT_VIDEO_format,
        SPA_POD_CHOICE_ENUM_Id(3, first, first, second), SPA_FORMAT_VIDEO_size,
        SPA_POD_Rectangle(&size), SPA_FORMAT_VIDEO_framerate, SPA_POD_Fraction(&rate));
    return pw.pw_stream_connect(p->stream, PW_DIRECTION_OUTPUT, PW_ID_ANY,
                                PW_STREAM_FLAG_DRIVER | PW_STREAM_FLAG_MAP_BUFFERS, params, 1);
}

/* Until the server has it. False: p->why says why not. */
static bool pipe_start(struct pipe *p)
{
    p->loop = pw.pw_thread_loop_new("lutetia stream", NULL);
    struct pw_properties *properties = pw.pw_properties_new(
        PW_KEY_MEDIA_TYPE, "Video", PW_KEY_MEDIA_CLASS, "Video/Source", PW_KEY_MEDIA_ROLE,
        "Camera", PW_KEY_NODE_NAME, "lutetia", PW_KEY_NODE_DESCRIPTION, "Lutetia's stage",
        PW_KEY_APP_NAME, "lutetia", NULL);
    if (!p->loop || !properties)
        return false;
    p->stream = pw.pw_stream_new_simple(pw.pw_thread_loop_get_loop(p->loop), "lutetia",
                                        properties, &events, p);
    if (!p->stream || pw.pw_thread_loop_start(p->loop) != 0)
        return false;
    pw.pw_thread_loop_lock(p->loop);
    const int connected = stream_connect(p);
    while (connected >= 0 && !p->up && !p->failed &&
           pw.pw_thread_loop_timed_wait(p->loop, START_S) == 0)
        ;
    const bool up = connected >= 0 && p->up && !p->failed;
    pw.pw_thread_loop_unlock(p->loop);
    return up;
}

static bool pipe_open(const struct picture_stream_def *def, void **own, char *why, size_t room)
{
    const char *missing;
    *own = NULL;
    if (!library_load("libpipewire-0.3.so.0", functions, sizeof functions / sizeof *functions,
                      &pw, &missing)) {
        snprintf(why, room, "PipeWire is not installed: install libpipewire-0.3-0%s%.60s",
                 missing ? "; this one has no " : "", missing ? missing : "");
        return false;
    }
    pw.pw_init(NULL, NULL);
    struct pipe *p = calloc(1, sizeof *p);
    if (p)
        p->def = *def;
    if (!p || !(p->rgba = malloc(picture_bytes(p)))) {
        snprintf(why, room, "no memory for a stream");
        free(p);
        return false;
    }
    if (!pipe_start(p)) {
        snprintf(why, room, "no PipeWire runs for this user%s%s", p->why[0] ? ": " : "",
                 p->why);
        pipe_close(p);
        return false;
    }
    *own = p;
    return true;
}

static bool pipe_send(void *own, const struct display_image *image, char *why, size_t room)
{
    struct pipe *p = own;
    const size_t count = (size_t)image->width_px * (size_t)image->height_px;
    const uint8_t *from = image->pixels;
    pw.pw_thread_loop_lock(p->loop);
    if (image->channels == 4)
        memcpy(p->rgba, from, 4 * count);
    for (size_t i = 0; image->channels == 3 && i < count; i++, from += 3) {
        memcpy(p->rgba + 4 * i, from, 3);
        p->rgba[4 * i + 3] = 255;
    }
    p->has_picture = true;
    const bool failed = p->failed;
    if (failed)
        snprintf(why, room, "%s", p->why);
    else if (p->streaming && pw.pw_stream_is_driving(p->stream))
        pw.pw_stream_trigger_process(p->stream);
    pw.pw_thread_loop_unlock(p->loop);
    return !failed;
}

const struct picture_way picture_way_pipewire = {pipe_open, pipe_send, pipe_close};
