/* demonstration_main.c - the process of a demonstration: see demonstration.h. Its words are the
 * starting process's number, the picture's sides, megabytes, and the seconds that a call may
 * compute; the script is its standard input. */
#include "demonstration_wire.h"

#include <confine.h>
#include <resident.h>
#include <script_live.h>
#include <visible_text.h>

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

struct process {
    int width_px, height_px;
    struct demonstration_memory *memory;
    struct script_live *live;
    char printed[DEMONSTRATION_TEXT_MAX + 1]; /* not told yet */
};

/* What the driver of the papers' machine and its compiler take besides: more ends in an error
 * of memory, wherever it is asked for. */
#define SYSTEM_MORE_BYTES 2e9

/* ---- telling ---- */

static void tell(const struct demonstration_message *m)
{
    uint8_t packet[DEMONSTRATION_PACKET_MAX];
    const size_t bytes = demonstration_message_write(m, packet);
    if (send(DEMONSTRATION_SOCKET, packet, bytes, MSG_NOSIGNAL) < 0)
        _exit(EXIT_SUCCESS); /* nobody looks any more */
}

static void text_tell(enum demonstration_kind kind, const char *text)
{
    struct demonstration_message m = {.kind = kind};
    visible_text(m.text, sizeof m.text, text);
    tell(&m);
}

/* Keeps the last line. */
static void print(void *context, const char *text, size_t length)
{
    struct process *p = context;
    while (length && text[length - 1] == '\n')
        length--;
    for (size_t i = length; i > 0; i--)
        if (text[i - 1] == '\n') {
            text += i;
            length -= i;
            break;
        }
    const size_t most = sizeof p->printed - 1, bytes = length < most ? length : most;
    memcpy(p->printed, text, bytes);
    p->printed[bytes] = '\0';
}

static void error(void *context, const char *text)
{
    (void)context;
    text_tell(DEMONSTRATION_FAILED, text);
}

static void overdue(void *context)
{
    (void)context;
    text_tell(DEMONSTRATION_FAILED, "it did not stop when its time was up; ended");
    _exit(EXIT_FAILURE);
}

static void overfull(void *context)
{
    (void)context;
    text_tell(DEMONSTRATION_FAILED, "it took more memory than its limit allows; ended");
    _exit(EXIT_FAILURE);
}

/* Those that the script has declared. */
static void controls_tell(const struct process *p)
{
    const struct script_live_control *from;
    for (int i = 0; (from = script_live_control(p->live, i)); i++) {
        struct demonstration_message m = {.kind = DEMONSTRATION_CONTROL, .which = i};
        struct demonstration_control *to = &m.control;
        to->least = from->row.least;
        to->most = from->row.most;
        to->usual = from->row.usual;
        to->value = from->value;
        to->curve = from->row.curve;
        visible_text(to->name, sizeof to->name, from->row.name);
        visible_text(to->unit, sizeof to->unit, from->row.unit);
        visible_text(to->choices, sizeof to->choices, from->row.choices);
        visible_text(to->does, sizeof to->does, from->row.does);
        tell(&m);
    }
}

/* ---- answering ---- */

static bool frame(struct process *p, const struct demonstration_message *m)
{
    const int which = (int)(m->number & 1);
    const size_t bytes = demonstration_picture_bytes(p->width_px, p->height_px);
    uint8_t *rgb = (uint8_t *)(p->memory + 1) + (size_t)which * bytes;
    if (m->seconds > 0 && !script_live_step(p->live, m->seconds))
        return false;
    atomic_store(&p->memory->number[which], 0);
    atomic_thread_fence(memory_order_release);
    if (!script_live_draw(p->live, rgb))
        return false;
    atomic_store(&p->memory->number[which], m->number);
    if (p->printed[0])
        text_tell(DEMONSTRATION_SAID, p->printed);
    p->printed[0] = '\0';
    tell(&(struct demonstration_message){
        .kind = DEMONSTRATION_SHOWN, .number = m->number, .which = which});
    return true;
}

static bool answer(struct process *p, const struct demonstration_message *m)
{
    static const char *const pointers[DEMONSTRATION_POINTERS] = {"down", "move", "up"};
    switch ((int)m->kind) {
    case DEMONSTRATION_FRAME:
        return frame(p, m);
    case DEMONSTRATION_POINTER:
        return script_live_pointer(p->live, pointers[m->which], m->x, m->y, m->pressure);
    case DEMONSTRATION_SET:
        return script_live_set(p->live, m->which, m->value);
    default:
        return script_live_key(p->live, m->kind == DEMONSTRATION_KEY, m->text);
    }
}

/* False: the script has failed. */
static bool answers(struct process *p)
{
    uint8_t packet[DEMONSTRATION_PACKET_MAX + 1];
    struct demonstration_message m;
    for (;;) {
        const ssize_t bytes = recv(DEMONSTRATION_SOCKET, packet, sizeof packet, 0);
        if (bytes <= 0)
            return true;
        if (demonstration_message_read(packet, (size_t)bytes, true, &m) && !answer(p, &m))
            return false;
    }
}

/* ---- beginning ---- */

/* All of the standard input. Owns: the caller frees it. */
static char *script_read(size_t *bytes)
{
    char *text = NULL;
    size_t room = 0;
    *bytes = 0;
    for (;;) {
        if (*bytes == room) {
            char *more = realloc(text, room = room ? 2 * room : 1 << 16);
            if (!more)
                break;
            text = more;
        }
        const ssize_t got = read(STDIN_FILENO, text + *bytes, room - *bytes);
        if (got <= 0)
            break;
        *bytes += (size_t)got;
    }
    return text;
}

static bool memory_map(struct process *p)
{
    void *memory = mmap(NULL, demonstration_memory_bytes(p->width_px, p->height_px),
                        PROT_READ | PROT_WRITE, MAP_SHARED, DEMONSTRATION_PICTURES, 0);
    p->memory = memory == MAP_FAILED ? NULL : memory;
    return p->memory != NULL;
}

static enum script_status script_begin(struct process *p, int memory_mb, double answer_s)
{
    size_t bytes;
    char *text = script_read(&bytes);
    const struct script_live_def def = {.text = text ? text : "",
                                        .bytes = text ? bytes : 0,
                                        .name = "live",
                                        .width_px = p->width_px,
                                        .height_px = p->height_px,
                                        .open_s = 4 * answer_s,
                                        .answer_s = answer_s,
                                        .memory_bytes = (size_t)memory_mb << 20,
                                        .print = print,
                                        .error = error,
                                        .overdue = overdue,
                                        .overfull = overfull,
                                        .context = p};
    const enum script_status status = script_live_open(&def, &p->live);
    free(text);
    return status;
}

int main(int argc, char **argv)
{
    static struct process process;
    int type = 0;
    socklen_t bytes = sizeof type;
    if (argc != 6 ||
        getsockopt(DEMONSTRATION_SOCKET, SOL_SOCKET, SO_TYPE, &type, &bytes) != 0) {
        visible_say("lutetia-demonstration: it is run by `lutetia read`, and is of no use by "
                    "itself");
        return EXIT_FAILURE;
    }
    process.width_px = atoi(argv[2]);
    process.height_px = atoi(argv[3]);
    const int memory_mb = atoi(argv[4]);
    confine_descriptors((int[]){DEMONSTRATION_SOCKET, DEMONSTRATION_PICTURES}, 2);
    confine_resources(atoi(argv[1]), UINT_MAX, 0);
    resident_limit(((double)memory_mb * (1 << 20)) + SYSTEM_MORE_BYTES);
    if (!memory_map(&process))
        return EXIT_FAILURE;
    if (script_begin(&process, memory_mb, strtod(argv[5], NULL)) != SCRIPT_OK)
        return EXIT_FAILURE;
    controls_tell(&process);
    const bool good = answers(&process);
    _exit(good ? EXIT_SUCCESS : EXIT_FAILURE); /* at once, without the driver's handlers */
}
