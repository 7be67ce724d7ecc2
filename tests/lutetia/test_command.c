/* test_command.c - the command as a user runs it: its results, and one clear line for each
 * error. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../display/scratch.h"
#include "child.h"

static const char *lutetia;

#define OUT "@out@"   /* a file in the scratch folder that must not exist afterwards */
#define JUNK "@junk@" /* a file there that is neither picture nor font */

/* Wrong command lines: the mistake, the arguments, the exit status, and two texts that the one
 * line must contain. */
static const struct {
    const char *name;
    const char *arguments[10];
    const char *variable;
    int status;
    const char *says, *says_too;
} wrongs[] = {
    {"no verb", {NULL}, NULL, 2, "usage", ""},
    {"unknown verb", {"draw"}, NULL, 2, "draw", "--help"},
    {"unknown option", {"paint", "x", "--bogus"}, NULL, 2, "--bogus", "--help"},
    {"no text", {"paint", "-o", OUT}, NULL, 2, "text", "--image"},
    {"text and image", {"paint", "x", "--image", JUNK, "-o", OUT}, NULL, 2, "text", "--image"},
    {"two texts", {"paint", "Wet", "Fonts", "-o", OUT}, NULL, 2, "quotes", "Fonts"},
    {"no value", {"paint", "x", "--steps"}, NULL, 2, "--steps", "value"},
    {"flag with letters",
     {"paint", "x", "--steps", "many", "-o", OUT},
     NULL,
     2,
     "--steps",
     "many"},
    {"steps below", {"paint", "x", "--steps", "-1", "-o", OUT}, NULL, 2, "--steps", "-1"},
    {"steps with tail", {"paint", "x", "--steps", "10k", "-o", OUT}, NULL, 2, "--steps", "10k"},
    {"steps overflow",
     {"paint", "x", "--steps", "99999999999999999999", "-o", OUT},
     NULL,
     2,
     "--steps",
     ""},
    {"pigment",
     {"paint", "x", "--pigment", "octarine", "-o", OUT},
     NULL,
     2,
     "octarine",
     "hansa yellow"},
    {"pigment with an amount",
     {"paint", "x", "--pigment", "burnt siena=1", "-o", OUT},
     NULL,
     2,
     "no 'burnt siena';",
     "burnt umber"},
    {"picture of another format",
     {"paint", "x", "-o", "out.jpg"},
     NULL,
     2,
     "--out",
     "FILE.png (got 'out.jpg')"},
    {"poster of another format",
     {"keys", "x.mid", "--sheet", "a.b/s.gif"},
     NULL,
     2,
     "--sheet",
     "FILE.png"},
    {"pigment's amount",
     {"paint", "x", "--pigment", "cyan=many", "-o", OUT},
     NULL,
     2,
     "-4..4",
     "many"},
    {"pigment twice",
     {"paint", "x", "--pigment", "cyan", "--pigment", "cyan=1", "-o", OUT},
     NULL,
     2,
     "twice",
     "cyan"},
    {"ink and pigment",
     {"paint", "x", "--pigment", "cyan", "--ink", "1,0,0", "-o", OUT},
     NULL,
     2,
     "--pigment",
     "one of them"},
    {"pigment of 1990",
     {"paint", "x", "--model", "thesis", "--pigment", "cyan", "-o", OUT},
     NULL,
     2,
     "--pigment",
     "--ink"},
    {"gravity nan", {"paint", "x", "--gravity", "nan", "-o", OUT}, NULL, 2, "--gravity", "nan"},
    {"gravity inf", {"paint", "x", "--gravity=inf", "-o", OUT}, NULL, 2, "--gravity", "inf"},
    {"the thesis's gravity zero",
     {"paint", "x", "--model", "thesis", "--gravity", "0", "-o", OUT},
     NULL,
     2,
     "--gravity",
     "0.5..2"},
    {"gravity of the thesis",
     {"paint", "x", "--gravity-x", "1.3", "-o", OUT},
     NULL,
     2,
     "--gravity-x",
     "-1..1"},
    {"weights of the thesis",
     {"paint", "x", "--weights", "1,1,1", "-o", OUT},
     NULL,
     2,
     "--weights",
     "--model thesis"},
    {"stock of the thesis",
     {"paint", "x", "--model", "thesis", "--stock", "rough", "-o", OUT},
     NULL,
     2,
     "--stock",
     ""},
    {"unknown stock", {"paint", "x", "--stock", "silk", "-o", OUT}, NULL, 2, "'silk'", "xuan"},
    {"unknown model",
     {"paint", "x", "--model", "half", "-o", OUT},
     NULL,
     2,
     "--model",
     "thesis"},
    {"humidity nan",
     {"paint", "x", "--humidity", "-nan", "-o", OUT},
     NULL,
     2,
     "--humidity",
     ""},
    {"humidity huge",
     {"paint", "x", "--humidity", "1e999", "-o", OUT},
     NULL,
     2,
     "--humidity",
     ""},
    {"water empty", {"paint", "x", "--water", "", "-o", OUT}, NULL, 2, "--water", ""},
    {"ink of two", {"paint", "x", "--ink", "1,0", "-o", OUT}, NULL, 2, "--ink", "C,M,Y"},
    {"ink of four", {"paint", "x", "--ink", "1,0,0,0", "-o", OUT}, NULL, 2, "--ink", "C,M,Y"},
    {"ink nan", {"paint", "x", "--ink", "1,nan,0", "-o", OUT}, NULL, 2, "--ink", "nan"},
    {"pool short",
     {"paint", "x", "--pool", "1,2,3", "-o", OUT},
     NULL,
     2,
     "--pool",
     "X,Y,W,H,A"},
    {"paper of size 0", {"paint", "x", "--paper", "0x0", "-o", OUT}, NULL, 2, "--paper", "0x0"},
    {"paper negative",
     {"paint", "x", "--paper", "-4x100", "-o", OUT},
     NULL,
     2,
     "--paper",
     "-4x100"},
    {"paper one number",
     {"paint", "x", "--paper", "100", "-o", OUT},
     NULL,
     2,
     "--paper",
     "WxH"},
    {"paper beyond any",
     {"paint", "x", "--paper", "999999x9", "-o", OUT},
     NULL,
     2,
     "--paper",
     "999999x9"},
    {"seed letters", {"paint", "x", "--seed", "0x12", "-o", OUT}, NULL, 2, "--seed", "0x12"},
    {"unknown view", {"paint", "x", "--view", "ink", "-o", OUT}, NULL, 2, "--view", "ink"},
    {"missing font",
     {"paint", "x", "--font", "NoSuchFont", "-o", OUT},
     NULL,
     1,
     "NoSuchFont",
     "font"},
    {"missing font file",
     {"paint", "x", "--font", "/nowhere/a.otf", "-o", OUT},
     NULL,
     1,
     "/nowhere/a.otf",
     ""},
    {"font that is none", {"paint", "x", "--font", JUNK, "-o", OUT}, NULL, 1, "not a font", ""},
    {"missing image",
     {"paint", "--image", "/nowhere/a.png", "-o", OUT},
     NULL,
     1,
     "/nowhere/a.png",
     ""},
    {"image that is none",
     {"paint", "--image", JUNK, "-o", OUT},
     NULL,
     1,
     "not a readable PNG",
     ""},
    {"image that is a folder",
     {"paint", "--image", "/", "-o", OUT},
     NULL,
     1,
     "/: cannot read",
     ""},
    {"text of spaces", {"paint", "   ", "-o", OUT}, NULL, 1, "no mark", ""},
    {"text empty", {"paint", "", "-o", OUT}, NULL, 1, "no mark", ""},
    {"text without glyphs",
     {"paint", "\xf0\x93\x80\x80", "--font", "DejaVuSerif", "-o", OUT},
     NULL,
     1,
     "no glyphs",
     "U+13000"},
    {"text not UTF-8", {"paint", "\xff\xfe", "-o", OUT}, NULL, 1, "UTF-8", ""},
    {"folder that cannot be",
     {"paint", "x", "--steps", "1", "--frames", "/proc/frames", "-o", OUT},
     NULL,
     1,
     "/proc/frames",
     ""},
    {"frames into a file",
     {"paint", "x", "--steps", "1", "--frames", JUNK, "-o", OUT},
     NULL,
     1,
     JUNK,
     "not a folder"},
    {"no platform", {"paint", "x", "-o", OUT}, "OCL_ICD_VENDORS=/nowhere", 1, "OpenCL", ""},
    {"a platform without devices",
     {"paint", "x", "-o", OUT},
     "POCL_CACHE_DIR=/proc/none",
     1,
     "has no device",
     "POCL_CACHE_DIR"},
    {"no such device", {"paint", "x", "-o", OUT}, "LUTETIA_DEVICE=nonsense", 1, "nonsense", ""},
    {"no device for the demo",
     {"demo", "-o", "/tmp"},
     "LUTETIA_DEVICE=nonsense",
     1,
     "nonsense",
     ""},
    {"paper beyond memory",
     {"paint", "x", "--paper", "16384x16384", "--steps", "1", "-o", OUT},
     "POCL_MEMORY_LIMIT=1",
     1,
     "smaller",
     "16384x16384"},
    {"unwritable place",
     {"paint", "x", "--paper", "64x64", "--steps", "1", "-o", "/proc/x.png"},
     NULL,
     1,
     "/proc/x.png",
     ""},
    {"missing place",
     {"paint", "x", "--paper", "64x64", "--steps", "1", "-o", "/nowhere/x.png"},
     NULL,
     1,
     "/nowhere/x.png",
     "folder"},
    {"a device",
     {"paint", "x", "--paper", "64x64", "--steps", "1", "-o", "/dev/full"},
     NULL,
     1,
     "/dev/full",
     "regular file"},
    {"place that is a folder",
     {"paint", "x", "--paper", "64x64", "--steps", "1", "-o", "/tmp"},
     NULL,
     1,
     "/tmp",
     ""},
    {"place that is not there, before the machine starts",
     {"paint", "x", "-o", "/nowhere/x.png"},
     "LUTETIA_DEVICE=none such",
     1,
     "/nowhere/x.png",
     "folder"},
    {"demo into a file", {"demo", "-o", JUNK}, NULL, 1, JUNK, "not a folder"},
    {"demo with words", {"demo", "now"}, NULL, 2, "now", ""},
    {"info with words", {"info", "me"}, NULL, 2, "me", ""},
    {"unknown benchmark", {"bench", "nothing"}, NULL, 2, "nothing", "--help"},
    {"no compiler", {"cc", "x.c"}, "CC=/nowhere/cc", 1, "/nowhere/cc", "CC"},
    {"no compiler of C++", {"cc", "x.cpp"}, "CXX=/nowhere/c++", 1, "/nowhere/c++", "CXX"},
};

enum { WRONGS_COUNT = sizeof wrongs / sizeof *wrongs };

static const char *argument_of(const char *argument)
{
    if (strcmp(argument, OUT) == 0)
        return scratch_path("out.png");
    if (strcmp(argument, JUNK) == 0)
        return scratch_path("junk");
    return argument;
}

static int lines_in(const char *text)
{
    int lines = 0;
    for (; *text; text++)
        lines += *text == '\n';
    return lines;
}

/* A wrong command prints one line, exits with the right status, and leaves no file under the
 * final name or beside it. */
static void wrong_is_said(void **state)
{
    size_t i = (size_t)(uintptr_t)*state;
    struct child child = {.arguments = {lutetia}, .variables = {wrongs[i].variable}};
    FILE *junk = fopen(scratch_path("junk"), "w");
    assert_non_null(junk);
    fputs("neither a font nor a picture\n", junk);
    fclose(junk);
    for (int a = 0; a < 10 && wrongs[i].arguments[a]; a++)
        child.arguments[a + 1] = argument_of(wrongs[i].arguments[a]);
    child_run(&child);
    const char *says = argument_of(wrongs[i].says);
    if (child.status != wrongs[i].status || !strstr(child.errors, says) ||
        !strstr(child.errors, wrongs[i].says_too))
        fail_msg("exit %d for %d, and it said: %s", child.status, wrongs[i].status,
                 child.errors);
    if (strcmp(wrongs[i].says, "usage") != 0 && lines_in(child.errors) != 1)
        fail_msg("it said more than one line: %s", child.errors);
    if (scratch_count() != 1)
        fail_msg("it left a file behind");
    unlink(scratch_path("junk"));
}

/* Empties the scratch folder before each case. */
static int begin_clean(void **state)
{
    (void)state;
    scratch_path("");
    scratch_empty();
    return 0;
}

static void run(struct child *child, int status)
{
    child->arguments[0] = lutetia;
    child_run(child);
    if (child->status != status)
        fail_msg("exit %d for %d: %s", child->status, status, child->errors);
}

static void paint_writes_a_picture(void **state)
{
    (void)state;
    const char *out = scratch_path("painted.png");
    struct child child = {.arguments = {"", "paint", "Aa", "--paper", "200x150", "--steps",
                                        "20", "--font", "DejaVuSerif", "--pool",
                                        "10,10,50,50,80", "-o", out}};
    run(&child, 0);
    assert_string_equal(child.errors, "");
    assert_string_equal(child.output, "");
    uint8_t head[24];
    FILE *file = fopen(out, "rb");
    assert_non_null(file);
    assert_int_equal(fread(head, 1, sizeof head, file), sizeof head);
    fclose(file);
    assert_memory_equal(head, "\x89PNG\r\n\x1a\n", 8);
    assert_int_equal(head[19], 200);
    assert_int_equal(head[23], 150);
    assert_int_equal(scratch_count(), 1);
    unlink(out);
}

static void same_seed_same_file_of(const char *model)
{
    static char bytes[2][1 << 18];
    size_t counts[2];
    for (int i = 0; i < 2; i++) {
        const char *out = scratch_path("same.png");
        struct child child = {.arguments = {"", "paint", "Aa", "--paper", "128x96", "--steps",
                                            "9", "--font", "DejaVuSerif", "--seed", "4", "-o",
                                            out, "--model", model},
                              .variables = {i ? "LUTETIA_EAGER=1" : "LUTETIA_EAGER=0"}};
        run(&child, 0);
        FILE *file = fopen(out, "rb");
        assert_non_null(file);
        counts[i] = fread(bytes[i], 1, sizeof bytes[i], file);
        fclose(file);
        unlink(out);
    }
    assert_int_equal(counts[0], counts[1]);
    assert_memory_equal(bytes[0], bytes[1], counts[0]);
}

/* Papers, pigments and views of all kinds are painted, and look different. */
static void papers_of_all_kinds(void **state)
{
    (void)state;
    enum { KINDS = 4 };
    static char bytes[KINDS][1 << 18];
    size_t counts[KINDS];
    static const char *const ways[KINDS][4] = {
        {"--model=thesis", "--weights", "1,0.5,0.5", "--gravity=1.5"},
        {"--pigment=burnt umber=0.8", "--stock", "rough", "--gravity=0.5"},
        {"--pigment=burnt umber=0.8", "--stock", "rough", "--light=0"},
        {"--ink", "0.2,0.8,0", "--stock=xuan", "--view=wet"}};
    for (int i = 0; i < KINDS; i++) {
        const char *out = scratch_path("kind.png");
        struct child child = {.arguments = {"", "paint", "Aa", "--paper", "96x64", "--steps",
                                            "9", "--font", "DejaVuSerif", "-o", out}};
        for (int k = 0; k < 4; k++)
            child.arguments[11 + k] = ways[i][k];
        run(&child, 0);
        assert_string_equal(child.errors, "");
        FILE *file = fopen(out, "rb");
        assert_non_null(file);
        counts[i] = fread(bytes[i], 1, sizeof bytes[i], file);
        fclose(file);
        unlink(out);
        for (int k = 0; k < i; k++)
            assert_false(counts[i] == counts[k] && memcmp(bytes[i], bytes[k], counts[i]) == 0);
    }
}

static void same_seed_same_file(void **state)
{
    (void)state;
    same_seed_same_file_of("full");
    same_seed_same_file_of("thesis");
}

static void frames_are_written(void **state)
{
    (void)state;
    struct child child = {.arguments = {"", "paint", "Aa", "--paper", "64x48", "--steps", "6",
                                        "--every", "3", "--font", "DejaVuSerif", "--frames",
                                        scratch_path("."), "-o", scratch_path("last.png")}};
    run(&child, 0);
    assert_int_equal(scratch_count(), 4);
    static const char *const names[] = {"frame-000000.png", "frame-000003.png",
                                        "frame-000006.png", "last.png"};
    for (int i = 0; i < 4; i++)
        assert_int_equal(unlink(scratch_path(names[i])), 0);
}

static void a_dump_that_cannot_be_is_said_once(void **state)
{
    (void)state;
    struct child child = {.arguments = {"", "paint", "Aa", "--paper", "64x48", "--steps", "6",
                                        "--font", "DejaVuSerif", "-o",
                                        scratch_path("last.png")},
                          .variables = {"LUTETIA_DUMP=/proc/none"}};
    run(&child, 1);
    assert_non_null(strstr(child.errors, "LUTETIA_DUMP: cannot write /proc/none"));
    assert_int_equal(lines_in(child.errors), 1);
    assert_int_equal(unlink(scratch_path("last.png")), 0);
}

static void full_disk_leaves_nothing(void **state)
{
    (void)state;
    struct child child = {.arguments = {"", "paint", "Aa", "--paper", "256x256", "--steps", "1",
                                        "--font", "DejaVuSerif", "-o", scratch_path("big.png")},
                          .file_bytes_max = 20000};
    run(&child, 1);
    assert_int_equal(lines_in(child.errors), 1);
    assert_int_equal(scratch_count(), 0);
}

static void interrupt_leaves_nothing(void **state)
{
    (void)state;
    struct child child = {.arguments = {"", "paint", "Aa", "--paper", "512x512", "--steps",
                                        "1000000", "--font", "DejaVuSerif", "-o",
                                        scratch_path("cut.png")},
                          .variables = {"LUTETIA_BACKGROUND=1"},
                          .interrupt_after_ms = 1500};
    run(&child, 130);
    assert_int_equal(lines_in(child.errors), 1);
    assert_int_equal(scratch_count(), 0);
}

static void help_is_everywhere(void **state)
{
    (void)state;
    struct child child = {.arguments = {"", "--help"}};
    run(&child, 0);
    int verbs = 0;
    for (const char *at = child.output; (at = strstr(at, "\n  ")); at += 3) {
        char name[32], usage[64];
        assert_int_equal(sscanf(at, " %31s", name), 1);
        snprintf(usage, sizeof usage, "usage: lutetia %s", name);
        struct child verb = {.arguments = {"", name, "--help"}};
        run(&verb, 0);
        assert_non_null(strstr(verb.output, usage));
        assert_string_equal(verb.errors, "");
        verbs++;
    }
    assert_true(verbs > 10);
}

static void version_is_told(void **state)
{
    (void)state;
    struct child child = {.arguments = {"", "--version"}};
    run(&child, 0);
    assert_memory_equal(child.output, "lutetia ", 8);
}

static void info_lists_devices_and_bits(void **state)
{
    (void)state;
    struct child child = {.arguments = {"", "info"}};
    run(&child, 0);
    assert_non_null(strstr(child.output, "358 bits"));
    assert_non_null(strstr(child.output, "chosen: "));
    assert_non_null(strstr(child.output, "kernel cache"));
}

static void output_that_is_full_is_noticed(void **state)
{
    (void)state;
    struct child child = {.arguments = {"", "paint", "--help"}, .output_full = true};
    run(&child, 1);
    assert_int_equal(lines_in(child.errors), 1);
}

static void cc_compiles_a_program_of_1990(void **state)
{
    (void)state;
    const char *source = scratch_path("old.c"), *program = scratch_path("old");
    FILE *file = fopen(source, "w");
    assert_non_null(file);
    fputs("#include <cm/paris.h>\n"
          "show (n)\n"
          "int n;\n"
          "{ printf (\"%d\\n\", n); }\n"
          "main ()\n"
          "{\n"
          "    CM_field_id_t f;\n"
          "    CM_init ();\n"
          "    f = CM_allocate_stack_field (8);\n"
          "    CM_u_move_constant_1L (f, 7, 8);\n"
          "    show ((int) CM_global_u_max_1L (f, 8));\n"
          "    exit (0);\n"
          "}\n",
          file);
    fclose(file);
    struct child compiler = {.arguments = {"", "cc", source, "-w", "-o", program}};
    run(&compiler, 0);
    struct child old = {.arguments = {program}};
    child_run(&old);
    assert_int_equal(old.status, 0);
    assert_string_equal(old.output, "7\n");
    unlink(source);
    unlink(program);
}

int main(void)
{
    lutetia = getenv("LUTETIA");
    if (!lutetia) {
        fputs("LUTETIA must name the command to test\n", stderr);
        return 1;
    }
    static char names[WRONGS_COUNT][64];
    struct CMUnitTest tests[WRONGS_COUNT + 16] = {
        cmocka_unit_test(help_is_everywhere),
        cmocka_unit_test(version_is_told),
        cmocka_unit_test(info_lists_devices_and_bits),
        cmocka_unit_test(output_that_is_full_is_noticed),
        cmocka_unit_test(paint_writes_a_picture),
        cmocka_unit_test(papers_of_all_kinds),
        cmocka_unit_test(same_seed_same_file),
        cmocka_unit_test(frames_are_written),
        cmocka_unit_test(a_dump_that_cannot_be_is_said_once),
        cmocka_unit_test(full_disk_leaves_nothing),
        cmocka_unit_test(interrupt_leaves_nothing),
        cmocka_unit_test(cc_compiles_a_program_of_1990),
    };
    size_t count = 0;
    while (tests[count].test_func)
        count++;
    for (size_t i = 0; i < count; i++)
        tests[i].setup_func = begin_clean;
    for (size_t i = 0; i < WRONGS_COUNT; i++) {
        snprintf(names[i], sizeof names[i], "wrong_%s", wrongs[i].name);
        for (char *c = names[i]; *c; c++)
            if (*c == ' ' || *c == '-')
                *c = '_';
        tests[count++] = (struct CMUnitTest){names[i], wrong_is_said, begin_clean, NULL,
                                             (void *)(uintptr_t)i};
    }
    return _cmocka_run_group_tests("command", tests, count, NULL, NULL);
}
