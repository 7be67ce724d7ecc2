/* test_map.c - maps as a program uses them: what they cost, time that leads them, a beat,
 * words, messages with addresses. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <script_map.h>

#include "scripted.h"

static void map_tell(void *context, const char *text)
{
    scripted_append(context, text, strlen(text));
}

static void map_overdue(void *context)
{
    (void)context;
    abort();
}

/* The process is its host's: what that takes is not the map's, which has 64 MB of its own.
 * (security.md 30) */
static void a_map_does_not_pay_for_its_host(void **state)
{
    (void)state;
    enum { MORE_BYTES = 300 << 20 };
    static char told[SCRIPTED_TEXT_MAX];
    const char *path = scratch_path("map.lua");
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs("function message(m) for i = 1, 100000 do end end", file);
    fclose(file);
    const struct script_map_def def = {
        .path = path, .tell = map_tell, .overdue = map_overdue, .context = told};
    const struct midi_message note = midi_message_make(0, MIDI_NOTE_ON, 60, 64);
    struct script_map *map;
    assert_int_equal(script_map_open(&def, &map), SCRIPT_OK);
    char *more = malloc(MORE_BYTES);
    assert_non_null(more);
    memset(more, 1, MORE_BYTES);
    for (int i = 0; i < 200; i++) /* the watchdog looks during some of them */
        if (!script_map_message(map, &note) && strstr(told, "memory"))
            fail_msg("%s", told);
    script_map_close(map);
    free(more);
}

static bool map_beat(void *context, double *phase, double *per_minute)
{
    (void)context;
    *phase = 0.25;
    *per_minute = 132;
    return true;
}

static const char *map_text(void *context, const char *words)
{
    (void)context;
    return strcmp(words, "no") == 0 ? "not this word" : NULL;
}

/* A map leads by time alone, hears a beat, and changes words; without a clock or words it is
 * told so. */
static void a_map_leads_by_time(void **state)
{
    (void)state;
    static char told[SCRIPTED_TEXT_MAX];
    const char *path = scratch_path("leads.lua");
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs("function frame(time) print(time, beat()) text(time > 1 and 'no' or 'yes') end",
          file);
    fclose(file);
    struct script_map_def def = {.path = path,
                                 .tell = map_tell,
                                 .overdue = map_overdue,
                                 .beat = map_beat,
                                 .text = map_text,
                                 .context = told};
    struct script_map *map;
    assert_int_equal(script_map_open(&def, &map), SCRIPT_OK);
    assert_true(script_map_leads(map));
    const struct midi_message note = midi_message_make(0, MIDI_NOTE_ON, 60, 64);
    assert_true(script_map_message(map, &note)); /* nobody asked for messages */
    assert_true(script_map_frame(map, 0.5));
    assert_string_equal(told, "0.5\t0.25\t132.0");
    told[0] = '\0';
    assert_false(script_map_frame(map, 1.5));
    assert_non_null(strstr(told, "not this word"));
    script_map_close(map);
    def.beat = NULL;
    def.text = NULL;
    told[0] = '\0';
    assert_int_equal(script_map_open(&def, &map), SCRIPT_OK);
    assert_false(script_map_frame(map, 0.5));
    assert_non_null(strstr(told, "0.5\tnil"));
    assert_non_null(strstr(told, "no words to change"));
    script_map_close(map);
    file = fopen(path, "wb");
    fputs("x = 1", file);
    fclose(file);
    assert_int_equal(script_map_open(&def, &map), SCRIPT_FAILED);
    assert_non_null(strstr(told, "or frame(time)"));
}

static const char *map_send(void *context, const char *address,
                            const struct script_map_argument *arguments, int count)
{
    char line[200];
    snprintf(line, sizeof line, "%s %d %s %g %g|", address, count, arguments[0].text,
             arguments[1].number, arguments[2].number);
    scripted_append(context, line, strlen(line));
    return strcmp(address, "/no") == 0 ? "not there" : NULL;
}

/* What comes with an address goes to osc(), and a map sends such messages itself. */
static void a_map_hears_and_sends_osc(void **state)
{
    (void)state;
    static char told[SCRIPTED_TEXT_MAX];
    const char *path = scratch_path("osc.lua");
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs("function osc(address, a, b) if address == '/in' then send('/out', a, b + 1, true) "
          "else send('/no', 'x', 1, 2) end end",
          file);
    fclose(file);
    struct script_map_def def = {.path = path,
                                 .tell = map_tell,
                                 .overdue = map_overdue,
                                 .send = map_send,
                                 .context = told};
    const struct script_map_argument arguments[] = {{"word", 0}, {NULL, 2.5}};
    struct script_map *map;
    assert_int_equal(script_map_open(&def, &map), SCRIPT_OK);
    assert_true(script_map_hears_osc(map) && !script_map_leads(map));
    assert_true(script_map_osc(map, "/in", arguments, 2));
    assert_string_equal(told, "/out 3 word 3.5 1|");
    assert_false(script_map_osc(map, "/else", arguments, 2));
    assert_non_null(strstr(told, "not there"));
    script_map_close(map);
    def.send = NULL;
    told[0] = '\0';
    assert_int_equal(script_map_open(&def, &map), SCRIPT_OK);
    assert_false(script_map_osc(map, "/in", arguments, 2));
    assert_non_null(strstr(told, "--osc-to"));
    script_map_close(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_map_does_not_pay_for_its_host),
                                       cmocka_unit_test(a_map_leads_by_time),
                                       cmocka_unit_test(a_map_hears_and_sends_osc)};
    return cmocka_run_group_tests_name("maps", tests, NULL, NULL);
}
