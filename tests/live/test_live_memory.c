/* test_live_memory.c - a stage that is played takes as much memory after ten times as many
 * notes, unpluggings, scenes and values of OSC.
 *
 * What is counted is what malloc has handed out. GLIBC_TUNABLES leave out its lists of each
 * thread, which count what was given back, and pieces in pages of their own. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <live_player.h>
#include <network.h>
#include <osc.h>
#include <springs.h>

#include "../display/scratch.h"
#include "../midi/server_support.h"
#include "clock.h"

#include <arpa/inet.h>
#include <malloc.h>
#include <netinet/in.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

/* A piece that is used again may be 16 bytes larger than one that was cut for it. */
enum { SLACK = 4096 };
enum { MASSES = 8, SCENE_PROGRAM = 2, STALL = 900, FEW = 70, MANY = 10 * FEW };

struct played {
    struct instrument instrument;
    struct served served;
    struct live_source *source;
    struct stage *stage;
    struct live_player *player;
    int osc;              /* a socket */
    long messages, plugs; /* that have come */
    double turn_s;
};

#ifdef __SANITIZE_ADDRESS__ /* its malloc is another one; gcc has no header of it */
size_t __sanitizer_get_current_allocated_bytes(void);
#endif

static size_t in_use(void)
{
#ifdef __SANITIZE_ADDRESS__
    return __sanitizer_get_current_allocated_bytes();
#else
    const struct mallinfo2 m = mallinfo2();
    return m.uordblks + m.hblkhd;
#endif
}

static void message_count(void *context, const struct midi_message *m, double late_s)
{
    struct played *p = context;
    (void)m, (void)late_s;
    p->messages++;
}

static void line_count(void *context, const char *text)
{
    struct played *p = context;
    p->plugs += strstr(text, " up") != NULL;
}

/* ---- a stage ---- */

static struct stage *masses_make(void)
{
    struct stage_springs_def springs = stage_springs_def_default();
    struct stage_def def = stage_def_default();
    struct stage *stage;
    assert_int_equal(dyn_network_create(&springs.network), DYN_OK);
    for (int i = 0; i < MASSES; i++) {
        struct dyn_mass mass = dyn_mass_usual();
        mass.x = i;
        mass.y = 0.5 + 0.2 * i;
        assert_int_equal(dyn_mass_add(springs.network, &mass, NULL), DYN_OK);
    }
    def.forgets = true;
    assert_int_equal(stage_springs_create(&springs, &def.actor), STAGE_OK);
    assert_int_equal(stage_create(&def, &stage), STAGE_OK);
    return stage;
}

/* A socket of this computer's own, connected to a port that was free. */
static int socket_make(char port[16])
{
    struct sockaddr_in at = {.sin_family = AF_INET,
                             .sin_addr = {.s_addr = htonl(INADDR_LOOPBACK)}};
    socklen_t bytes = sizeof at;
    const int free_port = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0),
              file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    assert_int_equal(bind(free_port, (struct sockaddr *)&at, sizeof at), 0);
    assert_int_equal(getsockname(free_port, (struct sockaddr *)&at, &bytes), 0);
    close(free_port);
    assert_int_equal(connect(file, (struct sockaddr *)&at, sizeof at), 0);
    snprintf(port, 16, "%d", ntohs(at.sin_port));
    return file;
}

static void played_begin(struct played *p)
{
    const char *knobs = scratch_path("memory.knobs");
    char port[16];
    FILE *file = fopen(knobs, "w");
    assert_non_null(file);
    fputs("knobs 1\nknob control * 7 safety 0 1\nscene 3 gravity 3.7\nend\n", file);
    fclose(file);
    p->instrument = instrument_plug("keys");
    p->served = served_begin(one_device(&p->instrument), 0, NULL);
    silence_skip(&p->instrument);
    p->osc = socket_make(port);
    p->stage = masses_make();
    const struct live_source_def source = {
        .server = p->served.path, .device = "keys", .lowest = 48, .no_computer = true};
    assert_int_equal(live_source_open(&source, &p->source), MIDI_OK);
    const struct live_player_def def = {.source = p->source,
                                        .knobs = &knobs,
                                        .knobs_count = 1,
                                        .osc = {.listen = port},
                                        .tell = line_count,
                                        .context = p,
                                        .played = message_count,
                                        .played_context = p};
    if (live_player_create(&def, p->stage, &p->player) != STAGE_OK)
        fail_msg("%s", stage_error());
}

static void played_end(struct played *p)
{
    live_player_destroy(p->player);
    stage_destroy(p->stage);
    live_source_close(p->source);
    close(p->osc);
    served_end(&p->served);
    instrument_unplug(&p->instrument);
}

static void turn(struct played *p)
{
    p->turn_s += 1.0 / 60;
    assert_int_equal(live_player_before(p->player, p->stage, p->turn_s), STAGE_OK);
    assert_int_equal(stage_frame(p->stage, p->turn_s, NULL), STAGE_OK);
}

/* Turns until so many have come. */
static void turn_until(struct played *p, const long *count, long wanted)
{
    const double until_s = clock_now_s() + 20;
    for (turn(p); *count < wanted; usleep(500), turn(p))
        if (clock_now_s() > until_s)
            fail_msg("%ld of %ld have come", *count, wanted);
}

/* ---- what is played ---- */

/* Messages that all come before the stage looks: it has been held up. */
static void notes_play(struct played *p, int count)
{
    uint8_t bytes[3 * STALL];
    for (int i = 0; i < count; i++) {
        const uint8_t note[3] = {0x90, (uint8_t)(36 + i / 2 % 48), (uint8_t)(i % 2 ? 0 : 90)};
        memcpy(bytes + 3 * i, note, sizeof note);
    }
    const long wanted = p->messages + count;
    instrument_send(&p->instrument, bytes, 3 * (size_t)count);
    usleep(count > 100 ? 60000 : 0);
    turn_until(p, &p->messages, wanted);
}

static void scene_play(struct played *p, int i)
{
    const uint8_t bytes[] = {0xc0, SCENE_PROGRAM, 0xb0, 7, (uint8_t)(i % 128)};
    const long wanted = p->messages + 2;
    instrument_send(&p->instrument, bytes, sizeof bytes);
    turn_until(p, &p->messages, wanted);
}

static void values_set(struct played *p, int count)
{
    uint8_t bytes[OSC_PACKET_MAX];
    for (int i = 0; i < count; i++) {
        size_t length = osc_message_write(bytes, sizeof bytes, "/control/restitution", "f",
                                          i % 100 / 100.0);
        assert_true(send(p->osc, bytes, length, 0) == (ssize_t)length);
        length = osc_message_write(bytes, sizeof bytes, "/control/restitution", "");
        assert_true(send(p->osc, bytes, length, 0) == (ssize_t)length);
        turn(p);
        assert_true(recv(p->osc, bytes, sizeof bytes, 0) > 0);
    }
}

static void plug_again(struct played *p)
{
    const long wanted = p->plugs + 1;
    instrument_unplug(&p->instrument);
    usleep(20000);
    instrument_again(&p->instrument);
    turn_until(p, &p->plugs, wanted);
    silence_skip(&p->instrument);
}

static size_t round_play(struct played *p, int count, int stall)
{
    for (int i = 0; i < count; i++) {
        notes_play(p, i % 10 ? 20 : stall);
        scene_play(p, i);
        values_set(p, 10);
        if (i % 35 == 34)
            plug_again(p);
    }
    turn(p);
    return in_use();
}

static void memory_does_not_grow(void **state)
{
    (void)state;
    struct played p = {0};
    played_begin(&p);
    const size_t few = round_play(&p, FEW, 40), many = round_play(&p, MANY, STALL);
    print_message("%zu bytes after %ld messages and %ld unpluggings\n", many, p.messages,
                  p.plugs);
    assert_in_range(many, few - SLACK, few + SLACK);
    played_end(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(memory_does_not_grow)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
