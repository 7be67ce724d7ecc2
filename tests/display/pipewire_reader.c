/* pipewire_reader.c - see pipewire_reader.h. */
#include "pipewire_reader.h"

#include <pipewire/pipewire.h>
#include <spa/param/video/format-utils.h>
#include <spa/utils/result.h>

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { WAIT_S = 5, NOBODY = -1 };

pid_t pipewire_daemon_start(char *folder, size_t room)
{
    char path[300];
    snprintf(folder, room, "/tmp/lutetia-pipewire-XXXXXX");
    if (!mkdtemp(folder))
        return -1;
    setenv("XDG_RUNTIME_DIR", folder, 1);
    snprintf(path, sizeof path, "%s/pipewire-0", folder);
    const pid_t daemon = fork();
    if (daemon == 0) {
        const int nothing = open("/dev/null", O_WRONLY);
        dup2(nothing, 1);
        dup2(nothing, 2);
        execlp("pipewire", "pipewire", (char *)NULL);
        _exit(127);
    }
    struct stat about;
    for (int i = 0; i < 200 && stat(path, &about) != 0; i++) {
        if (waitpid(daemon, NULL, WNOHANG) == daemon) {
            rmdir(folder);
            return -1;
        }
        usleep(25000);
    }
    return daemon;
}

void pipewire_daemon_end(pid_t daemon, const char *folder)
{
    char path[300];
    kill(daemon, SIGTERM);
    waitpid(daemon, NULL, 0);
    static const char *const left[] = {"pipewire-0", "pipewire-0.lock", "pipewire-0-manager",
                                       "pipewire-0-manager.lock"};
    for (size_t i = 0; i < sizeof left / sizeof *left; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, left[i]);
        unlink(path);
    }
    rmdir(folder);
}

struct pipewire_reader {
    struct pw_thread_loop *loop;
    struct pw_context *context;
    struct pw_core *core;
    struct pw_registry *registry;
    struct pw_stream *stream;
    struct pw_proxy *link;
    struct spa_hook registry_hook, stream_hook;
    const char *node;
    int node_id;
    bool is_slow;
    struct spa_video_info_raw info;
    struct display_image image;
    unsigned long come, taken;
};

static void global(void *context, uint32_t id, uint32_t permissions, const char *type,
                   uint32_t version, const struct spa_dict *props)
{
    struct pipewire_reader *r = context;
    (void)permissions;
    (void)version;
    const char *name = props ? spa_dict_lookup(props, PW_KEY_NODE_NAME) : NULL;
    if (strcmp(type, PW_TYPE_INTERFACE_Node) == 0 && name && strcmp(name, r->node) == 0) {
        r->node_id = (int)id;
        pw_thread_loop_signal(r->loop, false);
    }
}

static void param_changed(void *context, uint32_t id, const struct spa_pod *param)
{
    struct pipewire_reader *r = context;
    if (param && id == SPA_PARAM_Format)
        spa_format_video_raw_parse(param, &r->info);
}

static void state_changed(void *context, enum pw_stream_state old, enum pw_stream_state state,
                          const char *error)
{
    struct pipewire_reader *r = context;
    (void)old;
    (void)state;
    (void)error;
    pw_thread_loop_signal(r->loop, false);
}

/* Red first, four channels. */
static void picture_take(struct pipewire_reader *r, const struct spa_data *data)
{
    const int width = (int)r->info.size.width, height = (int)r->info.size.height;
    const bool blue_first =
        r->info.format == SPA_VIDEO_FORMAT_BGRA || r->info.format == SPA_VIDEO_FORMAT_BGRx;
    if (data->chunk->size < 4 * (uint32_t)width * (uint32_t)height)
        return; /* none was there yet */
    if (r->image.width_px != width || r->image.height_px != height) {
        display_image_destroy(&r->image);
        r->image =
            (struct display_image){.width_px = width, .height_px = height, .channels = 4};
        if (display_image_create(&r->image) != DISPLAY_OK)
            abort();
    }
    const uint8_t *from = (const uint8_t *)data->data + data->chunk->offset;
    for (size_t i = 0; i < 4 * (size_t)width * (size_t)height; i += 4) {
        r->image.pixels[i] = from[i + (blue_first ? 2 : 0)];
        r->image.pixels[i + 1] = from[i + 1];
        r->image.pixels[i + 2] = from[i + (blue_first ? 0 : 2)];
        r->image.pixels[i + 3] = from[i + 3];
    }
    r->come++;
    pw_thread_loop_signal(r->loop, false);
}

static void process(void *context)
{
    struct pipewire_reader *r = context;
    struct pw_buffer *buffer = pw_stream_dequeue_buffer(r->stream);
    if (!buffer)
        return;
    if (buffer->buffer->datas[0].data)
        picture_take(r, &buffer->buffer->datas[0]);
    if (r->is_slow)
        sleep(1);
    pw_stream_queue_buffer(r->stream, buffer);
}

static const struct pw_registry_events registry_events = {PW_VERSION_REGISTRY_EVENTS,
                                                          .global = global};
static const struct pw_stream_events stream_events = {
    PW_VERSION_STREAM_EVENTS, .state_changed = state_changed, .param_changed = param_changed,
    .process = process};

static int reader_connect(struct pipewire_reader *r)
{
    uint8_t bytes[1024];
    struct spa_pod_builder b = SPA_POD_BUILDER_INIT(bytes, sizeof bytes);
    const struct spa_rectangle usual = {320, 240}, least = {1, 1}, most = {8192, 8192};
    const struct spa_fraction rate = {25, 1}, slowest = {0, 1}, fastest = {1000, 1};
    const struct spa_pod *params[1];
    params[0] = spa_pod_builder_add_object(
        &b, SPA_TYPE_OBJECT_Format, SPA_PARAM_EnumFormat, SPA_FORMAT_mediaType,
        SPA_POD_Id(SPA_MEDIA_TYPE_video), SPA_FORMAT_mediaSubtype,
        SPA_POD_Id(SPA_MEDIA_SUBTYPE_raw), SPA_FORMAT_VIDEO_format,
        SPA_POD_CHOICE_ENUM_Id(5, SPA_VIDEO_FORMAT_RGBA, SPA_VIDEO_FORMAT_RGBA,
                               SPA_VIDEO_FORMAT_BGRA, SPA_VIDEO_FORMAT_RGBx,
                               SPA_VIDEO_FORMAT_BGRx),
        SPA_FORMAT_VIDEO_size, SPA_POD_CHOICE_RANGE_Rectangle(&usual, &least, &most),
        SPA_FORMAT_VIDEO_framerate, SPA_POD_CHOICE_RANGE_Fraction(&rate, &slowest, &fastest));
    return pw_stream_connect(r->stream, PW_DIRECTION_INPUT, PW_ID_ANY,
                             PW_STREAM_FLAG_MAP_BUFFERS, params, 1);
}

static bool wait_for(struct pipewire_reader *r)
{
    return pw_thread_loop_timed_wait(r->loop, WAIT_S) == 0;
}

/* The link from the node, as a session manager makes it. */
static bool link_make(struct pipewire_reader *r)
{
    const char *error;
    char out[16], in[16];
    while (r->node_id == NOBODY)
        if (!wait_for(r))
            return false;
    while (pw_stream_get_state(r->stream, &error) != PW_STREAM_STATE_PAUSED)
        if (!wait_for(r))
            return false;
    snprintf(out, sizeof out, "%d", r->node_id);
    snprintf(in, sizeof in, "%u", pw_stream_get_node_id(r->stream));
    struct pw_properties *props =
        pw_properties_new(PW_KEY_LINK_OUTPUT_NODE, out, PW_KEY_LINK_INPUT_NODE, in, NULL);
    r->link = pw_core_create_object(r->core, "link-factory", PW_TYPE_INTERFACE_Link,
                                    PW_VERSION_LINK, &props->dict, 0);
    pw_properties_free(props);
    return r->link != NULL;
}

struct pipewire_reader *pipewire_reader_open(const char *node, bool is_slow)
{
    pw_init(NULL, NULL);
    struct pipewire_reader *r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    r->node = node;
    r->node_id = NOBODY;
    r->is_slow = is_slow;
    r->loop = pw_thread_loop_new("reader", NULL);
    r->context = pw_context_new(pw_thread_loop_get_loop(r->loop), NULL, 0);
    pw_thread_loop_start(r->loop);
    pw_thread_loop_lock(r->loop);
    r->core = pw_context_connect(r->context, NULL, 0);
    bool ok = r->core != NULL;
    if (ok) {
        r->registry = pw_core_get_registry(r->core, PW_VERSION_REGISTRY, 0);
        pw_registry_add_listener(r->registry, &r->registry_hook, &registry_events, r);
        r->stream = pw_stream_new(
            r->core, "reader",
            pw_properties_new(PW_KEY_MEDIA_TYPE, "Video", PW_KEY_NODE_NAME, "reader", NULL));
        pw_stream_add_listener(r->stream, &r->stream_hook, &stream_events, r);
        ok = reader_connect(r) >= 0 && link_make(r);
    }
    pw_thread_loop_unlock(r->loop);
    if (ok)
        return r;
    pipewire_reader_close(r);
    return NULL;
}

void pipewire_reader_close(struct pipewire_reader *r)
{
    pw_thread_loop_stop(r->loop);
    if (r->link)
        pw_proxy_destroy(r->link);
    if (r->stream)
        pw_stream_destroy(r->stream);
    if (r->registry)
        pw_proxy_destroy((struct pw_proxy *)r->registry);
    if (r->core)
        pw_core_disconnect(r->core);
    pw_context_destroy(r->context);
    pw_thread_loop_destroy(r->loop);
    display_image_destroy(&r->image);
    free(r);
}

bool pipewire_reader_next(struct pipewire_reader *r, struct display_image *image)
{
    pw_thread_loop_lock(r->loop);
    bool ok = r->come != r->taken;
    r->taken = r->come;
    if (ok) {
        display_image_destroy(image);
        *image = r->image;
        image->pixels = NULL;
        ok = display_image_create(image) == DISPLAY_OK;
    }
    if (ok)
        memcpy(image->pixels, r->image.pixels,
               4 * (size_t)image->width_px * (size_t)image->height_px);
    pw_thread_loop_unlock(r->loop);
    return ok;
}

double pipewire_reader_fps(const struct pipewire_reader *r)
{
    return (double)r->info.framerate.num / r->info.framerate.denom;
}

bool pipewire_reader_alpha(const struct pipewire_reader *r)
{
    return r->info.format == SPA_VIDEO_FORMAT_BGRA || r->info.format == SPA_VIDEO_FORMAT_RGBA;
}
