/* test_filter.c - single filters, chains, and thinning: the messages that come out and their
 * times. The last value always comes out. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <midi_filter.h>

#include "../sample.h"
#include "oracle.h"

/* Reads messages with times, "TIME_MS words|TIME_MS words". Returns the last one's time in
 * ms. */
static int messages_read(const char *text, struct taken *out)
{
    char copy[1000], *rest = copy;
    int ms = 0, used = 0;
    snprintf(copy, sizeof copy, "%s", text);
    for (char *one; (one = strsep(&rest, "|"));) {
        struct midi_message m;
        assert_int_equal(sscanf(one, "%d %n", &ms, &used), 1);
        if (midi_message_read(one + used, &m) != MIDI_OK)
            fail_msg("%s: %s", one, midi_error());
        m.time_ns = (uint64_t)ms * 1000000;
        taken_add(out, &m);
    }
    return ms;
}

static void chain_run(const char *filters, const struct taken *in, struct taken *out)
{
    struct midi_chain *chain;
    if (midi_chain_create(filters, &chain) != MIDI_OK)
        fail_msg("%s: %s", filters, midi_error());
    for (size_t i = 0; i < in->count; i++) {
        /* First the messages that have become due, as in a server. */
        for (uint64_t due; (due = midi_chain_due_ns(chain)) <= in->messages[i].time_ns;)
            midi_chain_flush(chain, due, taken_add, out);
        midi_chain_take(chain, &in->messages[i], taken_add, out);
    }
    midi_chain_flush(chain, UINT64_MAX, taken_add, out);
    assert_int_equal(midi_chain_due_ns(chain), UINT64_MAX);
    midi_chain_destroy(chain);
}

static const struct {
    const char *filters, *in, *out;
} cases[] = {
    {"", "0 note-on 1 60 1|1 clock", "0 note-on 1 60 1|1 clock"},
    {"drop=aftertouch,sensing,clock",
     "0 note-on 1 60 1|1 pressure 1 3|2 poly-pressure 1 60 4|3 clock|4 sensing|5 start|6 bend "
     "1 5",
     "0 note-on 1 60 1|5 start|6 bend 1 5"},
    {"drop=sysex", "0 sysex f0 01|1 sysex 02 f7|2 clock", "2 clock"},
    {"keep=notes", "0 note-on 1 60 1|1 control 1 7 3|2 note-off 1 60 1|3 clock",
     "0 note-on 1 60 1|2 note-off 1 60 1"},
    {"channels=2-3,10",
     "0 note-on 1 60 1|1 note-on 2 60 1|2 note-on 3 60 1|3 note-on 10 60 1|4 start",
     "1 note-on 2 60 1|2 note-on 3 60 1|3 note-on 10 60 1|4 start"},
    {"notes=c2-c4", "0 note-on 1 c2 1|1 note-on 1 c4 1|2 note-on 1 c#4 1|3 note-off 1 b1 1",
     "0 note-on 1 c2 1|1 note-on 1 c4 1"},
    {"notes=c-1-c0", "0 note-on 1 0 1|1 note-on 1 12 1|2 note-on 1 13 1|3 control 1 90 3",
     "0 note-on 1 0 1|1 note-on 1 12 1|3 control 1 90 3"},
    {"transpose=-12", "0 note-on 1 c4 9|1 note-off 1 c4 9|2 note-on 1 11 9|3 control 1 60 9",
     "0 note-on 1 c3 9|1 note-off 1 c3 9|3 control 1 60 9"},
    {"velocity=fixed:99", "0 note-on 1 60 1|1 note-on 1 60 0|2 note-off 1 60 5",
     "0 note-on 1 60 99|1 note-on 1 60 0|2 note-off 1 60 5"},
    {"velocity=0.5", "0 note-on 1 60 127|1 note-on 1 60 32|2 note-on 1 60 0",
     "0 note-on 1 60 127|1 note-on 1 60 64|2 note-on 1 60 0"},
    {"velocity=20", "0 note-on 1 60 1", "0 note-on 1 60 1"},
    {"channel=5", "0 control 1 7 8|1 clock", "0 control 5 7 8|1 clock"},
    {"split=c4:2", "0 note-on 1 b3 1|1 note-on 1 c4 1|2 control 1 7 7",
     "0 note-on 2 b3 1|1 note-on 1 c4 1|2 control 1 7 7"},
    {"transpose=12 notes=c4-c5 channel=3", "0 note-on 1 c3 1|1 note-on 1 c4 1|2 note-on 1 c5 1",
     "0 note-on 3 c4 1|1 note-on 3 c5 1"},
    /* The first value goes out at once; of later values within 10 ms only the newest does, at
     * the end of that time. */
    {"thin=10", "0 control 1 7 1|2 control 1 7 2|4 control 1 7 3|20 control 1 7 4",
     "0 control 1 7 1|4 control 1 7 3|20 control 1 7 4"},
    {"thin=10", "0 bend 1 1|1 bend 1 2|2 bend 2 3|3 bend 2 4|4 bend 1 5",
     "0 bend 1 1|2 bend 2 3|4 bend 1 5|3 bend 2 4"},
    /* Held back values go out before the next other message of their channel. */
    {"thin=10", "0 control 1 7 1|1 control 1 7 2|2 note-on 2 60 9|3 note-on 1 60 9",
     "0 control 1 7 1|2 note-on 2 60 9|1 control 1 7 2|3 note-on 1 60 9"},
    {"thin=10", "0 control 1 64 127|1 control 1 64 0|2 control 1 6 1|3 control 1 6 2",
     "0 control 1 64 127|1 control 1 64 0|2 control 1 6 1|3 control 1 6 2"},
    {"thin=10", "0 poly-pressure 1 60 1|1 poly-pressure 1 61 2|2 poly-pressure 1 60 3",
     "0 poly-pressure 1 60 1|1 poly-pressure 1 61 2|2 poly-pressure 1 60 3"},
    {"thin=10 transpose=1", "0 poly-pressure 1 60 1|1 poly-pressure 1 60 2",
     "0 poly-pressure 1 61 1|1 poly-pressure 1 61 2"},
};

static void filters_do_as_they_say(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct taken in = {0}, expected = {0}, got = {0};
        messages_read(cases[i].in, &in);
        messages_read(cases[i].out, &expected);
        chain_run(cases[i].filters, &in, &got);
        bool same = taken_equal(&got, &expected);
        for (size_t k = 0; same && k < got.count; k++)
            same = got.messages[k].time_ns == expected.messages[k].time_ns;
        if (!same) {
            char text[MIDI_TEXT_MAX] = "nothing";
            for (size_t k = 0; k < got.count; k++) {
                midi_message_text(&got.messages[k], text);
                print_message("%d %s\n", (int)(got.messages[k].time_ns / 1000000), text);
            }
            fail_msg("%s: of %s", cases[i].filters, cases[i].in);
        }
        taken_finish(&in);
        taken_finish(&expected);
        taken_finish(&got);
    }
}

/* Random messages: the thinned ones are some of the original ones, and each controller's last
 * value is the same. Other messages are unchanged and in order. Between two other messages of
 * its channel no controller comes more often than it may. */
static void thinning_keeps_every_last_value(void **unused)
{
    (void)unused;
    uint64_t seed = 3;
    for (int turn = 0; turn < 50; turn++) {
        struct taken in = {0}, out = {0};
        uint8_t last_in[16][32] = {{0}}, last_out[16][32] = {{0}};
        uint64_t now_ns = 0;
        for (int i = 0; i < 500; i++) {
            const uint64_t any = sample_word(&seed);
            const uint8_t channel = any & 3, value = (uint8_t)(any >> 8 & 127);
            now_ns += (any >> 16) % 4000000;
            struct midi_message m =
                any >> 40 & 7 ? midi_message_make(now_ns, (uint8_t)(0xb0 | channel),
                                                  (uint8_t)(7 + (any >> 48) % 4), value)
                              : midi_message_make(now_ns, (uint8_t)(0x90 | channel), 60, value);
            taken_add(&in, &m);
        }
        chain_run("thin=25", &in, &out);
        assert_true(out.count < in.count);
        size_t others_in = 0, others_out = 0;
        for (size_t i = 0; i < in.count; i++) {
            const uint8_t *b = in.messages[i].bytes;
            if (b[0] < 0xb0)
                others_in++;
            else
                last_in[b[0] & 15][b[1]] = b[2];
        }
        uint64_t last_note_ns = 0;
        for (size_t i = 0; i < out.count; i++) {
            const uint8_t *b = out.messages[i].bytes;
            if (b[0] < 0xb0) {
                others_out++;
                assert_true(out.messages[i].time_ns >= last_note_ns);
                last_note_ns = out.messages[i].time_ns;
            } else {
                last_out[b[0] & 15][b[1]] = b[2];
            }
        }
        assert_int_equal(others_in, others_out);
        assert_memory_equal(last_in, last_out, sizeof last_in);
        taken_finish(&in);
        taken_finish(&out);
    }
}

/* A chain takes any message that a parser gives, and its messages are well-formed. */
static void chains_take_generated_messages(void **unused)
{
    (void)unused;
    static const char *const chains[] = {
        "thin=1", "drop=controls thin=5 transpose=40", "split=c4:3 channels=1-3 velocity=3",
        "keep=notes,pressure,sysex channel=16 thin=2 notes=20-100"};
    static uint8_t bytes[20000];
    uint64_t seed = 11;
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        struct taken in = {0}, out = {0};
        struct midi_parser_counts counts;
        oracle_bytes(&seed, bytes, sizeof bytes);
        oracle_parse(bytes, sizeof bytes, &in, &counts);
        for (size_t i = 0; i < in.count; i++)
            in.messages[i].time_ns = i * 300000;
        chain_run(chains[c], &in, &out);
        assert_true(out.count > 0 && out.count < in.count);
        for (size_t i = 0; i < out.count; i++)
            assert_true(midi_message_good(&out.messages[i]));
        taken_finish(&in);
        taken_finish(&out);
    }
}

static void wrong_chains_are_refused(void **unused)
{
    (void)unused;
    static const char *const wrong[][2] = {
        {"loud=3", "known are drop"},
        {"drop=everything", "known are note-off"},
        {"drop", "needs a value"},
        {"drop=", "needs a value"},
        {"channels=0", "1..16"},
        {"channels=4-2", "1..16"},
        {"channels=1,", "1..16"},
        {"notes=c6-c2", "low to high"},
        {"notes=x", "low to high"},
        {"notes=c-1-", "low to high"},
        {"transpose=200", "-127..127"},
        {"transpose=1.5", "-127..127"},
        {"velocity=nan", "0.05..20"},
        {"velocity=fixed:0", "1..127"},
        {"channel=17", "1..16"},
        {"split=c4", "c4:2"},
        {"thin=0", "0.1..10000"},
        {"thin=1 thin=1 thin=1 thin=1 thin=1 thin=1 thin=1 thin=1 thin=1 thin=1 thin=1 thin=1 "
         "thin=1 thin=1 thin=1 thin=1 thin=1",
         "at most 16"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct midi_chain *chain;
        if (midi_chain_create(wrong[i][0], &chain) != MIDI_BAD_ARGUMENT ||
            !strstr(midi_error(), wrong[i][1]))
            fail_msg("%s: %s", wrong[i][0], midi_error());
        assert_null(chain);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(filters_do_as_they_say),
        cmocka_unit_test(thinning_keeps_every_last_value),
        cmocka_unit_test(chains_take_generated_messages),
        cmocka_unit_test(wrong_chains_are_refused),
    };
    return cmocka_run_group_tests_name("filter", tests, NULL, NULL);
}
