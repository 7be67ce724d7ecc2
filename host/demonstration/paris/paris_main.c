/* paris_main.c - the keeper of a demonstration that is a program: see keeper.h. Its words are
 * those of demonstration_main.c; the program's text is its standard input. */
#include "keeper.h"

#include <confine.h>
#include <input_file.h>
#include <jail.h>
#include <resident.h>
#include <visible_text.h>

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { THREADS_MOST = 64 };
/* OLD_S: a picture is asked for and nothing new has come: the present one. UNSEEN_S: none has
 * been asked for, so the program rests. LOOK_S: between looks at what it takes. */
static const double OLD_S = 0.03, UNSEEN_S = 0.3, LOOK_S = 0.02;

struct keeper {
    int width_px, height_px, memory_mb;
    double answer_s;
    struct demonstration_memory *memory;
    struct build build;
    struct seen seen;
    struct lines lines;
    long told;    /* of the lines */
    bool runs;    /* the program does, not the compiler */
    bool stopped; /* by a signal of ours */
    bool over;    /* it has ended, with that status */
    int status;
    uint32_t asked; /* the number of a picture; 0: none */
    double asked_s, answered_s, began_s, looked_s;
    double silent_s; /* that the window has looked, and nothing came */
};

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- telling ---- */

_Noreturn static void leave(struct keeper *k)
{
    build_end(&k->build, true);
    build_remove(&k->build);
    _exit(EXIT_SUCCESS);
}

static void tell(struct keeper *k, const struct demonstration_message *m)
{
    uint8_t packet[DEMONSTRATION_PACKET_MAX];
    const size_t bytes = demonstration_message_write(m, packet);
    if (send(DEMONSTRATION_SOCKET, packet, bytes, MSG_NOSIGNAL) < 0)
        leave(k); /* nobody looks any more */
}

static void text_tell(struct keeper *k, enum demonstration_kind kind, const char *text)
{
    struct demonstration_message m = {.kind = kind};
    visible_text(m.text, sizeof m.text, text);
    tell(k, &m);
}

/* Those lines that are kept and have not been told. */
static void lines_tell(struct keeper *k)
{
    if (k->lines.count - k->told > LINES_KEPT)
        k->told = k->lines.count - LINES_KEPT;
    for (; k->told < k->lines.count; k->told++)
        text_tell(k, DEMONSTRATION_LINE, k->lines.kept[k->told % LINES_KEPT]);
}

_Noreturn static void fail(struct keeper *k, const char *why)
{
    lines_tell(k);
    text_tell(k, DEMONSTRATION_FAILED, why);
    leave(k);
}

/* ---- what is printed ---- */

/* What there is, up to as much as a picture's time has room for. True: something came. */
static bool printed_take(struct keeper *k)
{
    enum { AT_ONCE = 64 };
    char bytes[4096];
    bool came = false;
    for (int i = 0; i < AT_ONCE; i++) {
        const ssize_t got = read(k->build.printed, bytes, sizeof bytes);
        if (got <= 0)
            break;
        lines_add(&k->lines, bytes, (size_t)got);
        came = true;
    }
    return came;
}

/* ---- the compiler ---- */

/* The lines that say what is wrong: errors, and if there are none, all. */
struct complaints {
    struct lines all, errors, warnings;
};

static void complaint_add(struct complaints *c, const char *line)
{
    const char *own = strstr(line, "/program.c:"); /* the folder's name says nothing */
    line = own ? own + 1 : line;
    struct lines *to = strstr(line, "error:") || strstr(line, "undefined reference")
                           ? &c->errors
                       : strstr(line, "warning:") ? &c->warnings
                                                  : NULL;
    if (to && to->count < LINES_KEPT) {
        lines_add(to, line, strlen(line));
        lines_end(to);
    }
}

static struct complaints complaints;

/* The compiler's words come line by line; of millions the first of each kind count. */
static void complaints_take(void)
{
    static struct lines *const l = &complaints.all;
    static long looked;
    if (l->count - looked > LINES_KEPT)
        looked = l->count - LINES_KEPT;
    for (; looked < l->count; looked++)
        complaint_add(&complaints, l->kept[looked % LINES_KEPT]);
}

static void compiler_read(struct keeper *k)
{
    enum { AT_ONCE = 256 };
    char bytes[256]; /* few lines */
    for (int i = 0; i < AT_ONCE; i++) {
        const ssize_t got = read(k->build.printed, bytes, sizeof bytes);
        if (got <= 0)
            return;
        lines_add(&complaints.all, bytes, (size_t)got);
        complaints_take();
    }
}

static void begin_program(struct keeper *k)
{
    char why[300];
    k->lines = complaints.warnings;
    close(k->build.printed);
    if (!build_run(&k->build, k->memory_mb, why, sizeof why))
        fail(k, why);
    k->runs = true;
    text_tell(k, DEMONSTRATION_SAID, "");
    resident_limit(1e9); /* what displays may take of this process */
}

static void compiler_ended(struct keeper *k)
{
    compiler_read(k);
    lines_end(&complaints.all);
    complaints_take();
    const int status = build_end(&k->build, false);
    if (WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS) {
        begin_program(k);
        return;
    }
    const struct lines *l = complaints.errors.count ? &complaints.errors : &complaints.all;
    k->lines = *l;
    char why[DEMONSTRATION_TEXT_MAX];
    snprintf(why, sizeof why, DEMONSTRATION_UNCOMPILED ": %s",
             l->count ? l->kept[complaints.errors.count ? 0 : (l->count - 1) % LINES_KEPT]
                      : "the compiler was ended by its limits of time and memory");
    fail(k, why);
}

static void compiler_turn(struct keeper *k)
{
    siginfo_t ended = {0};
    compiler_read(k);
    if (waitid(P_PID, (id_t)k->build.process, &ended, WEXITED | WNOHANG | WNOWAIT) == 0 &&
        ended.si_pid == k->build.process)
        compiler_ended(k);
    else if (now_s() - k->began_s > 4 * k->answer_s)
        fail(k, DEMONSTRATION_UNCOMPILED ": the compiler took too long; ended");
}

/* ---- the program ---- */

static double field_read(pid_t process, const char *file, int number)
{
    char path[64];
    double value = 0;
    snprintf(path, sizeof path, "/proc/%d/%s", (int)process, file);
    FILE *f = input_file_open(path, NULL);
    for (int i = 0; f && i < number; i++)
        if (fscanf(f, "%*s") < 0)
            break;
    if (f && fscanf(f, "%lf", &value) != 1)
        value = 0;
    if (f)
        fclose(f);
    return value;
}

/* What it takes: more than its limits ends it. */
static void program_look(struct keeper *k)
{
    enum { RESIDENT = 1, THREADS = 19 };
    const double more = 64e6, most = k->memory_mb * 1048576.0 + more;
    if (now_s() - k->looked_s < LOOK_S || k->over)
        return;
    k->looked_s = now_s();
    if (field_read(k->build.process, "statm", RESIDENT) * (double)sysconf(_SC_PAGESIZE) > most)
        fail(k, "it took more memory than its limit allows; ended");
    if (field_read(k->build.process, "stat", THREADS) > THREADS_MOST)
        fail(k, "it started more threads than it may; ended");
}

static void program_reap(struct keeper *k)
{
    siginfo_t ended = {0};
    if (k->over || waitid(P_PID, (id_t)k->build.process, &ended, WEXITED | WNOHANG | WNOWAIT) ||
        ended.si_pid != k->build.process)
        return;
    k->over = true;
    k->status = build_end(&k->build, false);
}

/* All that it has shown was seen. */
_Noreturn static void program_ended(struct keeper *k)
{
    char why[200];
    printed_take(k);
    lines_end(&k->lines);
    if (WIFSIGNALED(k->status))
        snprintf(why, sizeof why, "the program was ended by a signal: %s",
                 strsignal(WTERMSIG(k->status)));
    else if (WEXITSTATUS(k->status) != EXIT_SUCCESS)
        snprintf(why, sizeof why, "the program ended with status %d", WEXITSTATUS(k->status));
    else
        snprintf(why, sizeof why, "the program has come to its end");
    fail(k, why);
}

static void rest(struct keeper *k, bool stop)
{
    if (k->over || k->stopped == stop)
        return;
    kill(k->build.process, stop ? SIGSTOP : SIGCONT);
    k->stopped = stop;
}

/* ---- pictures ---- */

static void picture_show(struct keeper *k)
{
    const int which = (int)(k->asked & 1);
    const size_t bytes = demonstration_picture_bytes(k->width_px, k->height_px);
    uint8_t *rgb = (uint8_t *)(k->memory + 1) + (size_t)which * bytes;
    if (!seen_draw(&k->seen))
        fail(k, "there is no memory for its picture");
    atomic_store(&k->memory->number[which], 0);
    atomic_thread_fence(memory_order_release);
    memcpy(rgb, k->seen.rgb, bytes);
    atomic_store(&k->memory->number[which], k->asked);
    lines_tell(k);
    tell(k, &(struct demonstration_message){
                .kind = DEMONSTRATION_SHOWN, .number = k->asked, .which = which});
    k->asked = 0;
    k->answered_s = now_s();
}

/* A picture is asked for: the next thing to be seen, or after a while what there is. */
static void picture_turn(struct keeper *k)
{
    bool came = false;
    const char *why = NULL;
    char text[300];
    const bool ended = k->over; /* before the look: nothing comes behind it */
    const bool printed = printed_take(k);
    if (!seen_take(&k->seen, k->build.lights, k->build.displays, &came, &why)) {
        snprintf(text, sizeof text, "what it shows is damaged: %s", why);
        fail(k, text);
    }
    if (came || printed)
        k->silent_s = 0;
    if (k->silent_s > 6 * k->answer_s)
        fail(k, "it has shown and printed nothing for too long; ended");
    if (ended && !came && !printed)
        program_ended(k);
    if (came || now_s() - k->asked_s > OLD_S)
        picture_show(k);
}

/* ---- all of it ---- */

/* What the window says: pictures, and that it has gone. Programs hear no pointer, no keys. */
static void window_take(struct keeper *k)
{
    uint8_t packet[DEMONSTRATION_PACKET_MAX + 1];
    struct demonstration_message m;
    const ssize_t bytes = recv(DEMONSTRATION_SOCKET, packet, sizeof packet, MSG_DONTWAIT);
    if (bytes < 0 && (errno == EAGAIN || errno == EINTR))
        return;
    if (bytes <= 0)
        leave(k);
    if (!demonstration_message_read(packet, (size_t)bytes, true, &m) ||
        m.kind != DEMONSTRATION_FRAME)
        return;
    k->asked = m.number;
    k->asked_s = now_s();
    k->silent_s += k->runs ? m.seconds : 0;
    rest(k, false);
}

static void turn(struct keeper *k)
{
    struct pollfd all[4] = {
        {.fd = DEMONSTRATION_SOCKET, .events = POLLIN},
        {.fd = k->asked || !k->runs ? k->build.printed : -1, .events = POLLIN},
        {.fd = k->asked ? k->build.lights : -1, .events = POLLIN},
        {.fd = k->asked ? k->build.displays : -1, .events = POLLIN}};
    /* ends of what has ended are always ready: then nothing is waited for */
    poll(all, k->over ? 1 : 4, k->asked ? (k->over ? 1 : 10) : 20);
    if (all[0].revents)
        window_take(k);
    if (!k->runs) {
        compiler_turn(k);
    } else {
        program_look(k);
        program_reap(k);
    }
    if (k->asked && k->runs)
        picture_turn(k);
    else if (k->asked && now_s() - k->asked_s > OLD_S)
        picture_show(k);
    else if (k->runs && !k->asked && now_s() - k->answered_s > UNSEEN_S)
        rest(k, true);
}

static char *text_read(size_t *bytes)
{
    enum { MOST = 1 << 20 };
    char *text = malloc(MOST);
    *bytes = 0;
    for (ssize_t got; text && *bytes < MOST; *bytes += (size_t)got)
        if ((got = read(STDIN_FILENO, text + *bytes, MOST - *bytes)) <= 0)
            break;
    return text;
}

static void begin(struct keeper *k)
{
    char why[300] = "no memory";
    size_t bytes;
    char *text = text_read(&bytes);
    if (!jail_possible())
        fail(k, "this system has nothing that keeps a program from your files (Landlock, "
                "Linux 5.13 or later), so none is run");
    if (!text || !seen_make(&k->seen, k->width_px, k->height_px) ||
        !build_folder(&k->build, text, bytes, why, sizeof why) ||
        !build_compile(&k->build, (unsigned)(4 * k->answer_s) + 1, why, sizeof why))
        fail(k, why);
    free(text);
    text_tell(k, DEMONSTRATION_SAID, "It is being compiled ...");
    k->began_s = k->answered_s = now_s();
}

int main(int argc, char **argv)
{
    static struct keeper k = {.build = {.printed = -1, .lights = -1, .displays = -1}};
    int type = 0;
    socklen_t bytes = sizeof type;
    if (argc != 6 ||
        getsockopt(DEMONSTRATION_SOCKET, SOL_SOCKET, SO_TYPE, &type, &bytes) != 0) {
        visible_say(
            "lutetia-demonstration-paris: it is run by `lutetia read`, and is of no use "
            "by itself");
        return EXIT_FAILURE;
    }
    k.width_px = atoi(argv[2]);
    k.height_px = atoi(argv[3]);
    k.memory_mb = atoi(argv[4]);
    k.answer_s = strtod(argv[5], NULL);
    confine_descriptors((int[]){DEMONSTRATION_SOCKET, DEMONSTRATION_PICTURES}, 2);
    prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0);
    void *memory = mmap(NULL, demonstration_memory_bytes(k.width_px, k.height_px),
                        PROT_READ | PROT_WRITE, MAP_SHARED, DEMONSTRATION_PICTURES, 0);
    if (memory == MAP_FAILED)
        return EXIT_FAILURE;
    k.memory = memory;
    begin(&k);
    for (;;)
        turn(&k);
}
