/* debug.c - what is in the machine, as answers to a debugger: see debug.h. */
#include "debug.h"

#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "machine_inside.h"
#include "paris_state.h"

enum { TEXT_ROOM = 1 << 16, PATIENCE_S = 120, PATIENCE_LOCKED_S = 15 };

/* ---- an answer ---- */

static struct answer {
    uint64_t bytes, text_bytes;
    char text[]; /* then the arrays */
} * answer;

static bool answer_begin(uint64_t arrays_bytes)
{
    if (answer)
        munmap(answer, answer->bytes);
    const uint64_t bytes = sizeof *answer + TEXT_ROOM + arrays_bytes;
    void *room = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    answer = room == MAP_FAILED ? NULL : room;
    if (!answer)
        return false;
    answer->bytes = bytes;
    return true;
}

static uint8_t *arrays(void)
{
    return (uint8_t *)answer->text + TEXT_ROOM;
}

PARIS_PRINTF(1, 2) static void add(const char *format, ...)
{
    va_list args;
    const uint64_t at = answer->text_bytes;
    va_start(args, format);
    const int length = vsnprintf(answer->text + at, TEXT_ROOM - at, format, args);
    va_end(args);
    if (length > 0 && at + (uint64_t)length < TEXT_ROOM)
        answer->text_bytes += (uint64_t)length;
}

/* The text anew: why there is no answer. Texts of ours and of the machine have no control
 * characters. */
static const void *refused(const char *why)
{
    if (!answer && !answer_begin(0))
        return NULL;
    answer->text_bytes = 0;
    add("{\"error\": \"");
    for (const char *c = why; *c; c++)
        add(*c == '"' || *c == '\\' ? "\\%c" : "%c", *c);
    add("\"}");
    return answer;
}

static const char *not_now(void)
{
    static char text[100];
    const char *busy = paris_the.machine ? machine_busy(paris_the.machine) : NULL;
    if (!paris_the.machine)
        return "there is no machine yet: CM_init makes it";
    snprintf(text, sizeof text, "the machine is busy: %s", busy ? busy : "");
    return busy ? text : NULL;
}

/* ---- in a child ---- */

/* Waits for the child, without a word to the program's own handler of children's ends. NULL: it
 * did what it should. */
static const char *child_wait(pid_t child)
{
    static char text[100];
    int status = 0;
    pid_t ended;
    while ((ended = waitpid(child, &status, 0)) < 0 && errno == EINTR)
        ;
    if (ended != child)
        return "the process that looks was lost";
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return NULL;
    if (CM_debug_locked && WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        return "the program holds a lock of the C library, as after a crash there: `run` again "
               "and stop before it";
    if (CM_debug_locked && WIFSIGNALED(status))
        return "the program has crashed, and what it has damaged is needed to look: `run` "
               "again "
               "and stop before it";
    snprintf(text, sizeof text, "the process that looks ended by %s %d",
             WIFSIGNALED(status) ? "signal" : "status",
             WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
    return text;
}

/* Calls the function where nothing that it does changes this process, if that can be. NULL: it
 * was called. */
static const char *aside(void (*look)(struct machine *m, const void *what), const void *what)
{
    /* a program that ignores its children's ends could not wait for this one */
    const struct sigaction usual = {.sa_handler = SIG_DFL};
    struct sigaction own;
    sigset_t ends, before, waiting;
    if (!machine_forks(paris_the.machine)) {
        machine_begin(paris_the.machine);
        look(paris_the.machine, what);
        return NULL;
    }
    sigemptyset(&ends);
    sigaddset(&ends, SIGCHLD);
    sigpending(&waiting);
    pthread_sigmask(SIG_BLOCK, &ends, &before);
    sigaction(SIGCHLD, &usual, &own);
    const pid_t child = CM_debug_locked ? machine_fork_bare() : fork();
    if (child == 0) {
        signal(SIGALRM, SIG_DFL);
        alarm(CM_debug_locked ? PATIENCE_LOCKED_S : PATIENCE_S);
        machine_begin(paris_the.machine);
        look(paris_the.machine, what);
        _exit(0);
    }
    const char *why = child < 0 ? "no process can be made to look" : child_wait(child);
    if (child > 0 && !sigismember(&waiting, SIGCHLD))
        sigtimedwait(&ends, NULL, &(struct timespec){0, 0});
    sigaction(SIGCHLD, &own, NULL);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return why;
}

/* ---- fields and flags ---- */

struct look {
    struct machine_field_info info;
    struct paris_operand operand;
    bool as_stored, flag_only;
    enum machine_flag flag;
    int set;
};

static void say_set(struct machine *m, int set)
{
    const struct paris_geometry *g = &paris_the.geometries[paris_the.set_geometry[set] - 1];
    add("\"vp_set\": %d, \"count\": %llu, \"axes\": [", set,
        (unsigned long long)machine_vpset_count(m, set));
    for (int axis = 0; axis < g->rank; axis++)
        add("%s%d", axis ? ", " : "", g->dimensions[axis]);
    add("]");
}

/* A float that was stored as one is one; else bits are a number without sign. */
static struct paris_operand as_stored(struct machine *m, struct paris_operand a)
{
    const struct machine_type type = machine_field_stored(m, a.field, a.len);
    if (type.kind == MACHINE_FLOAT)
        return type.width == 32 ? paris_f(a.field, 23, 8) : paris_f(a.field, 52, 11);
    return a;
}

static struct machine_type type_of(struct paris_operand a)
{
    return a.letter == 'f' ? machine_float_type((int)a.len, (int)a.e) : MACHINE_UINT(a.len);
}

/* The context first, one byte for each processor, then the values. */
static void look_at(struct machine *m, const void *what)
{
    const struct look *l = what;
    const uint64_t count = machine_vpset_count(m, l->set);
    struct paris_operand a = l->operand;
    enum machine_status status =
        machine_flag_download(m, l->set, l->flag_only ? l->flag : MACHINE_CONTEXT, arrays());
    if (status == MACHINE_OK && !l->flag_only) {
        a = l->as_stored ? as_stored(m, a) : a;
        status = machine_field_download(m, a.field, type_of(a), arrays() + count);
    }
    if (status != MACHINE_OK) {
        refused(machine_error(m));
        machine_error_clear(m);
        return;
    }
    add("{\"letter\": \"%c\", \"len\": %u, \"e\": %u, \"element\": %zu, \"at\": %zu, ",
        l->flag_only ? 'u' : a.letter, l->flag_only ? 1 : a.len, a.e,
        l->flag_only ? 1 : machine_element_bytes(type_of(a)), sizeof *answer + TEXT_ROOM);
    if (!l->flag_only)
        add("\"base\": %u, \"bits\": %u, \"offset\": %u, \"stored\": %s, ", l->info.base,
            l->info.bits, l->info.offset, l->as_stored ? "true" : "false");
    say_set(m, l->set);
    add("}");
}

static const void *look(const struct look *l, uint64_t element)
{
    const uint64_t count = machine_vpset_count(paris_the.machine, l->set);
    if (!answer_begin(count * (1 + element)))
        return refused("not enough memory for an answer");
    const char *why = aside(look_at, l);
    return why ? refused(why) : answer;
}

/* The field and its type. NULL: l is complete. */
static const char *look_prepare(struct look *l, unsigned int field, unsigned int letter,
                                unsigned int len, unsigned int e)
{
    static char text[160];
    const char *why = not_now();
    if (why)
        return why;
    snprintf(text, sizeof text, "there is no field %u (any more)", field);
    if (!machine_field_lookup(paris_the.machine, field, &l->info))
        return text;
    const unsigned int there = l->info.bits - l->info.offset;
    l->set = l->info.vpset;
    l->as_stored = !letter;
    if (letter == 'f' && !len) {
        len = there == 64 ? 52 : 23;
        e = there == 64 ? 11 : 8;
    }
    l->operand = (struct paris_operand){letter ? (char)letter : 'u', false, field,
                                        len ? len : there,           e,     {.bits = 0}};
    const unsigned int bits = paris_operand_bits(l->operand);
    snprintf(text, sizeof text, "the field has %u bits from here on; %u were asked for", there,
             bits);
    if (bits > there || !bits)
        return text;
    if (len)
        snprintf(text, sizeof text, "a number has at most %d bits; %u were asked for",
                 PARIS_INTEGER_MAX, bits);
    else
        snprintf(text, sizeof text, "it has %u bits: say which, as in `field f u 32`", bits);
    if (bits > PARIS_INTEGER_MAX)
        return text;
    if (letter == 'f' && (len < 1 || len > 52 || e < 2 || e > 11))
        return "a float has 1 to 52 bits of significand and 2 to 11 of exponent";
    return NULL;
}

const void *CM_debug_field(unsigned int field, unsigned int letter, unsigned int len,
                           unsigned int e)
{
    struct look l = {.flag_only = false};
    const char *why = look_prepare(&l, field, letter, len, e);
    if (why)
        return refused(why);
    struct machine_type type = type_of(l.operand);
    return look(&l, machine_element_bytes(type));
}

const void *CM_debug_flag(unsigned int flag)
{
    struct look l = {.flag_only = true, .flag = (enum machine_flag)flag};
    const char *why = not_now();
    if (why)
        return refused(why);
    if (flag > MACHINE_OVERFLOW)
        return refused("there is no such flag");
    l.set = CM_current_vp_set;
    return look(&l, 0);
}

const void *CM_debug_state(void)
{
    struct machine_field_info info;
    if (!answer_begin(0))
        return NULL;
    if (!paris_the.machine)
        return refused(not_now());
    struct machine *m = paris_the.machine;
    const struct machine_waiting waiting = machine_waiting(m);
    add("{\"call\": \"%s\", \"device\": \"%.100s\", \"values\": %llu, \"calls\": %llu, "
        "\"processors\": %d, ",
        paris_the.call, machine_device_name(m), (unsigned long long)waiting.values,
        (unsigned long long)waiting.calls, machine_processors_count(m));
    say_set(m, CM_current_vp_set);
    add(", \"fields\": [");
    /* room for the end, and for one of them */
    for (int i = 0; machine_field_at(m, i, &info) && answer->text_bytes + 400 < TEXT_ROOM; i++)
        add("%s[%u, %u, %d, \"%s\", %s]", i ? ", " : "", info.base, info.bits, info.vpset,
            info.region == MACHINE_STACK ? "stack" : "heap",
            machine_field_waits(m, info.base) ? "true" : "false");
    add("]}");
    return answer;
}

/* ---- watches ---- */

enum { WATCHES = 8 };

static struct watch {
    unsigned int how; /* 0: none */
    struct paris_operand operand;
    struct machine_type type;
    uint64_t index, count;
    struct machine_scalar was;
    uint8_t *all, *before; /* of a watch for NaNs anywhere: what is, and which were */
} watches[WATCHES];

static bool is_nan(struct machine_type type, const uint8_t *at)
{
    double number = 0;
    float single = 0;
    if (type.width == 32) {
        memcpy(&single, at, sizeof single);
        return single != single;
    }
    memcpy(&number, at, sizeof number);
    return number != number;
}

static void number_print(char *text, size_t size, const struct watch *w,
                         struct machine_scalar x)
{
    float single = 0;
    const unsigned int bits = w->operand.len;
    if (w->operand.letter == 'f') {
        memcpy(&single, &x.lo, sizeof single);
        snprintf(text, size, w->type.width == 32 ? "%.9g" : "%.17g",
                 w->type.width == 32 ? (double)single : paris_double(x.lo));
    } else if (x.hi) {
        snprintf(text, size, "0x%llx%016llx", (unsigned long long)x.hi,
                 (unsigned long long)x.lo);
    } else if (w->operand.letter == 's' && bits <= 64 && x.lo >> (bits - 1)) {
        snprintf(text, size, "%lld",
                 (long long)(x.lo | (bits < 64 ? ~(uint64_t)0 << bits : 0)));
    } else {
        snprintf(text, size, "%llu", (unsigned long long)x.lo);
    }
}

/* One processor. True: text says what happened. */
static bool one_happened(struct machine *m, struct watch *w, char *text, size_t size)
{
    struct machine_scalar now;
    char old[60], new[60];
    if (machine_field_read(m, w->operand.field, w->type, w->index, &now) != MACHINE_OK)
        return false;
    const bool differs = now.lo != w->was.lo || now.hi != w->was.hi;
    const bool is = w->how == PARIS_WATCH_NAN ? is_nan(w->type, (uint8_t *)&now.lo) &&
                                                    !is_nan(w->type, (uint8_t *)&w->was.lo)
                                              : differs;
    number_print(old, sizeof old, w, w->was);
    number_print(new, sizeof new, w, now);
    snprintf(text, size, "processor %llu: %s, was %s", (unsigned long long)w->index, new, old);
    w->was = now;
    return is;
}

/* All of them. */
static bool any_happened(struct machine *m, struct watch *w, char *text, size_t size)
{
    const size_t element = machine_element_bytes(w->type);
    uint64_t first = w->count, fresh = 0;
    if (machine_field_download(m, w->operand.field, w->type, w->all) != MACHINE_OK)
        return false;
    for (uint64_t i = 0; i < w->count; i++) {
        const bool is = is_nan(w->type, w->all + i * element);
        if (is && !w->before[i]) {
            first = first == w->count ? i : first;
            fresh++;
        }
        w->before[i] = is;
    }
    snprintf(text, size, "%llu processors have become NaN, the first is %llu",
             (unsigned long long)fresh, (unsigned long long)first);
    return fresh > 0;
}

static bool happened(struct machine *m, struct watch *w, char *text, size_t size)
{
    return w->all ? any_happened(m, w, text, size) : one_happened(m, w, text, size);
}

void CM_debug_unwatch(unsigned int watch)
{
    if (watch < 1 || watch > WATCHES)
        return;
    free(watches[watch - 1].all);
    free(watches[watch - 1].before);
    watches[watch - 1] = (struct watch){.how = 0};
    bool any = false;
    for (int i = 0; i < WATCHES; i++)
        any = any || watches[i].how;
    paris_the.watches_look = any ? paris_the.watches_look : NULL;
}

/* Stops the debugger if what it watches has happened in the call. */
static void watches_look(const char *call)
{
    struct machine *m = paris_the.machine;
    struct machine_field_info info;
    char what[200], text[400];
    if (!m || machine_busy(m))
        return;
    for (unsigned int i = 0; i < WATCHES; i++) {
        struct watch *w = &watches[i];
        if (!w->how)
            continue;
        if (!machine_field_lookup(m, w->operand.field, &info)) {
            snprintf(text, sizeof text,
                     "watch %u: %s: the field is gone, and the watch with it", i + 1, call);
            CM_debug_unwatch(i + 1);
            paris_debug_tell(text);
        } else if (happened(m, w, what, sizeof what)) {
            snprintf(text, sizeof text, "watch %u: %s: %s", i + 1, call, what);
            paris_debug_tell(text);
        }
    }
}

static const char *watch_prepare(struct watch *w, unsigned long index, unsigned int how)
{
    const size_t element = machine_element_bytes(w->type);
    char text[200];
    w->how = how;
    w->index = index;
    if (how != PARIS_WATCH_CHANGES && how != PARIS_WATCH_NAN)
        return "a watch is for changes, or for NaNs";
    if (how == PARIS_WATCH_NAN && w->operand.letter != 'f')
        return "only floats become NaN: say `f`, as in `watch-field x f nan`";
    if (index == ~0ul && how == PARIS_WATCH_NAN) {
        w->all = malloc(w->count * element);
        w->before = calloc(w->count, 1);
        if (!w->all || !w->before)
            return "not enough memory to watch all processors";
    } else if (index >= w->count) {
        return "there is no such processor";
    }
    happened(paris_the.machine, w, text, sizeof text);
    return NULL;
}

unsigned int CM_debug_watch(unsigned int field, unsigned int letter, unsigned int len,
                            unsigned int e, unsigned long index, unsigned int how)
{
    struct look l = {.flag_only = false};
    const char *why = look_prepare(&l, field, letter, len, e);
    unsigned int free_one = 0;
    while (free_one < WATCHES && watches[free_one].how)
        free_one++;
    if (!why && free_one == WATCHES)
        why = "there are 8 watches already";
    if (!why) {
        struct machine *m = paris_the.machine;
        struct watch *w = &watches[free_one];
        machine_begin(m);
        w->operand = l.as_stored ? as_stored(m, l.operand) : l.operand;
        w->type = type_of(w->operand);
        w->count = machine_vpset_count(m, l.set);
        why = watch_prepare(w, index, how);
        if (why)
            CM_debug_unwatch(free_one + 1);
    }
    if (why)
        snprintf(CM_debug_text, sizeof CM_debug_text, "%s", why);
    if (!why)
        paris_the.watches_look = watches_look;
    return why ? 0 : free_one + 1;
}
