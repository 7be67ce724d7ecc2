/* test_voice_transcript.c - subtitles as texts with times. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include <voice_transcript.h>

static void cues_are(const char *text, const char *expected)
{
    struct voice_transcript t;
    char why[300] = "", found[1000] = "";
    if (!voice_transcript_parse("x", text, strlen(text), &t, why, sizeof why))
        fail_msg("%s", why);
    for (int i = 0; i < t.count; i++)
        snprintf(found + strlen(found), sizeof found - strlen(found), "%g-%g %s|",
                 t.cues[i].begin_s, t.cues[i].end_s, t.cues[i].text);
    assert_string_equal(found, expected);
    voice_transcript_finish(&t);
}

static void refused(const char *text, const char *says)
{
    struct voice_transcript t;
    char why[300] = "";
    assert_false(voice_transcript_parse("x", text, strlen(text), &t, why, sizeof why));
    if (!strstr(why, says))
        fail_msg("'%s' is not in: %s", says, why);
    assert_true(t.count == 0 && !t.cues && !t.text);
}

static void subtitles_are_read(void **state)
{
    (void)state;
    cues_are("1\r\n00:00:01,000 --> 00:00:02,500\r\nThe <i>elephant</i>.\r\nWhy\r\n\r\n"
             "2\r\n01:00:03,250 --> 01:00:04,000 X1:1\r\n{\\an8}so?\r\n",
             "1-2.5 The elephant.  Why|3603.25-3604 so?|");
    cues_are("\xef\xbb\xbfWEBVTT a title\n\nNOTE what\nnobody reads\n\nSTYLE\n::cue {}\n\n"
             "intro\n00:01.000 --> 00:03.000 align:start\n"
             "<v Ann>A &amp; <00:01.500>B <00:02.000><b>C</b>\n\n00:02.500 --> 00:04.000\nD",
             "1-1.5 A & |1.5-2 B |2-2.5 C|2.5-4 D|");
    cues_are("00:01.000 --> 00:02.000\n\n00:03.000 --> 00:04.000\n \n\n"
             "00:05.000 --> 00:06.000\nlast {a} < b",
             "5-6 last {a} < b|");
}

static void what_is_wrong_is_said(void **state)
{
    (void)state;
    refused("", "no cue");
    refused("hello\nthere\n", "no cue");
    refused("00:01.000 -> 00:02.000\na\n", "no cue");
    refused("1\n00:00:02,000 --> 00:00:01,000\na\n", "x:2: a cue must end");
    refused("1\n0:61,000 --> 00:00:01,000\na\n", "x:2: a cue's times");
    refused("00:05.000 --> 00:06.000\na\n\n00:01.000 --> 00:02.000\nb\n", "x:4: this begins");
    refused("00:05.000 --> 00:06.000\na <00:09.000>b\n", "x:1: a time within");
    refused("NOTE 00:05.000 --> 00:06.000\na\n", "x:1: a note");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(subtitles_are_read),
                                       cmocka_unit_test(what_is_wrong_is_said)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
