/* test_files.c - files that include others: in their places, beside an oracle that puts texts
 * together itself; and what is not included: files elsewhere, circles, too deep, too many
 * (security.md 37). */
#include <reader_files.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../sample.h"
#include "without_library.h"

static char folder[] = "/tmp/lutetia-files-XXXXXX";

static const char *path_of(const char *name)
{
    static char paths[4][200];
    static int next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static void file_write(const char *name, const char *text)
{
    FILE *file = fopen(path_of(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static char *file_read(const char *path)
{
    char *text = calloc(1, 1 << 20);
    FILE *file = fopen(path, "r");
    assert_non_null(text);
    assert_non_null(file);
    assert_true(fread(text, 1, (1 << 20) - 1, file) > 0);
    fclose(file);
    return text;
}

struct read {
    struct reader_document *document;
    struct reader_files files;
};

static enum reader_status read_try(struct read *r, const char *path)
{
    char *text = strcmp(path, "-") == 0 ? strdup("[a](b.md \"include\")") : file_read(path);
    *r = (struct read){0};
    assert_int_equal(reader_document_create(&r->document), READER_OK);
    enum reader_status status =
        reader_files_add(&r->files, r->document, path, text, strlen(text));
    if (status == READER_OK)
        status = reader_files_refer(&r->files, r->document);
    if (status == READER_OK)
        status = reader_document_plain(r->document);
    free(text);
    return status;
}

static struct read read_now(const char *name)
{
    struct read r;
    if (read_try(&r, path_of(name)) != READER_OK)
        fail_msg("%s", reader_error());
    return r;
}

static void read_end(struct read *r)
{
    reader_document_destroy(r->document);
    reader_files_finish(&r->files);
}

/* ---- references between files ---- */

/* To labels of other files of the document, numbers and citations; a file that is none of its
 * own stays a link. */
static void references_lead_to_other_files(void **state)
{
    (void)state;
    mkdir(path_of("deep"), 0700);
    file_write("all.md",
               "# All\n\nBy [#](deep/one.md#fig), [page #](deep/one.md#two), [#](all.md#t), "
               "[#](none.md#x), [#](deep/one.md#none), [#](deep/one.md#entry).\n\n"
               "<a id=\"t\"></a>\n\n| a |\n|---|\n| b |\n\n"
               "[One](deep/one.md \"include\")\n");
    file_write("deep/one.md",
               "## Two\n\n<a id=\"fig\"></a>\n![P](p.png)\n\nSee [#](../all.md#t).\n\n"
               "<a id=\"bibliography\"></a>\n\n- Z\n- <a id=\"entry\"></a>A\n");
    struct read r = read_now("all.md");
    assert_string_equal(
        r.document->plain,
        "# All\n\nBy Figure 1, page Two, Table 1, #, [#](deep/one.md#none), 1.\n\na\n\nb\n\n"
        "## Two\n\nFigure 1: P\n\nSee Table 1.\n\nA \xe2\x86\x91\n\nZ\n\n");
    assert_int_equal(r.document->lost_all, 1);
    read_end(&r);
}

/* ---- in their places ---- */

static void files_stand_in_their_places(void **state)
{
    (void)state;
    mkdir(path_of("deep"), 0700);
    file_write("book.md",
               "# Book\n\nBefore[^1]. [#](#pond)\n\n[Reeds](deep/reeds.md \"include\")\n\n"
               "Between [no](deep/mud.md \"include\") words.\n\n[Mud](deep/mud.md)\n\n"
               "- [Mud](deep/mud.md \"include\")\n\n[Mud](deep/mud.md \"include\")\n\n"
               "After.\n\n[^1]: One.\n");
    file_write("deep/reeds.md",
               "## Reeds\n\n[Mud](mud.md \"include\")\n\nIn reeds[^1].\n\n[^1]: Two.\n");
    file_write("deep/mud.md", "Mud.\n\n<a id=\"pond\"></a>\n![Pond](pond.png)\n");
    struct read r = read_now("book.md");
    assert_string_equal(r.document->plain,
                        "# Book\n\nBefore1. Figure 1\n\n## Reeds\n\nMud.\n\nFigure 1: Pond\n\n"
                        "In reeds2.\n\nBetween no words.\n\nMud\n\nMud\n\nMud.\n\n"
                        "Figure 2: Pond\n\nAfter.\n\nOne.\n\nTwo.\n\n");
    assert_int_equal(r.files.count, 4);
    assert_int_equal(r.files.refused_all, 0);
    assert_string_equal(r.files.paths[0], path_of("book.md"));
    assert_string_equal(r.files.paths[1], path_of("deep/reeds.md"));
    /* each block knows the file that it comes from: pictures are beside that */
    for (int i = 0; i < r.document->blocks_count; i++) {
        const struct reader_block *b = &r.document->blocks[i];
        const char *path = r.files.paths[b->source];
        assert_int_equal(b->kind == READER_PICTURE || strcmp(b->text, "Mud.") == 0,
                         strcmp(path, path_of("deep/mud.md")) == 0);
        assert_int_equal(strcmp(b->text, "Reeds") == 0 || strcmp(b->text, "In reeds2.") == 0,
                         strcmp(path, path_of("deep/reeds.md")) == 0);
    }
    read_end(&r);
}

enum { FILES = 8, EXPANDED_BYTES = 1 << 20 };

/* What a file says where each of its includes is replaced by what that says. */
static void expand(int file, char *to)
{
    char name[40], *kept;
    snprintf(name, sizeof name, "r%d.md", file);
    char *text = file_read(path_of(name));
    for (char *line = strtok_r(text, "\n", &kept); line; line = strtok_r(NULL, "\n", &kept)) {
        int other;
        const size_t used = strlen(to);
        if (sscanf(line, "[x](r%d.md \"include\")", &other) == 1)
            expand(other, to);
        else
            snprintf(to + used, EXPANDED_BYTES - used, "%s\n\n", line);
    }
    free(text);
}

/* Files by chance that include later ones say what all of it in one file says. */
static void includes_are_what_they_say(void **state)
{
    (void)state;
    uint64_t chance = 5;
    for (int turn = 0; turn < 60; turn++) {
        for (int i = 0; i < FILES; i++) {
            char text[2000] = "", name[40];
            int includes = 0;
            for (int k = 0, n = 1 + (int)(sample_word(&chance) % 6); k < n; k++) {
                const uint64_t kind = sample_word(&chance) % 4;
                const size_t used = strlen(text);
                if (kind == 0 && i + 1 < FILES && includes++ < 2)
                    snprintf(text + used, sizeof text - used, "[x](r%d.md \"include\")\n\n",
                             i + 1 + (int)(sample_word(&chance) % (uint64_t)(FILES - i - 1)));
                else
                    snprintf(text + used, sizeof text - used, "%sF%d L%d\n\n",
                             kind == 1   ? "# "
                             : kind == 2 ? "- "
                                         : "",
                             i, k);
            }
            snprintf(name, sizeof name, "r%d.md", i);
            file_write(name, text);
        }
        char *all = calloc(1, EXPANDED_BYTES);
        assert_non_null(all);
        expand(0, all);
        struct read r = read_now("r0.md");
        struct reader_document *whole;
        assert_int_equal(reader_document_create(&whole), READER_OK);
        assert_int_equal(reader_document_add(whole, all, strlen(all)), READER_OK);
        assert_int_equal(reader_document_plain(whole), READER_OK);
        assert_string_equal(r.document->plain, whole->plain);
        assert_int_equal(r.files.refused_all, 0);
        for (int i = 0; i < r.document->labels_count;
             i++) { /* they are of their blocks still */
            const struct reader_label *label = &r.document->labels[i];
            const struct reader_block *block = &r.document->blocks[label->block];
            int file, line;
            assert_int_equal(sscanf(label->name, "f%d-l%d", &file, &line), 2);
            char heading[40];
            snprintf(heading, sizeof heading, "F%d L%d", file, line);
            assert_string_equal(block->text, heading);
            assert_int_equal(block->source, label->source);
        }
        reader_document_destroy(whole);
        read_end(&r);
        free(all);
    }
}

/* ---- what is not included ---- */

/* The document stands with its link, and one line says why. */
static void is_refused(const char *target, const char *why)
{
    char text[600], line[300];
    snprintf(text, sizeof text, "A.\n\n[link](%s \"include\")\n\nB.\n", target);
    file_write("bad.md", text);
    struct read r = read_now("bad.md");
    snprintf(line, sizeof line, "%s:3: ", path_of("bad.md"));
    if (r.files.refused_count != 1 || strncmp(r.files.refused[0], line, strlen(line)) != 0 ||
        !strstr(r.files.refused[0], why) || strchr(r.files.refused[0], '\n'))
        fail_msg("'%s': %s", target, r.files.refused_count ? r.files.refused[0] : "included");
    assert_string_equal(r.document->plain, "A.\n\nlink\n\nB.\n\n");
    assert_int_equal(r.files.count, 1);
    read_end(&r);
}

static void files_elsewhere_are_refused(void **state)
{
    (void)state;
    static const char elsewhere[] = "lies in the document's folder or below it";
    mkdir(path_of("deep"), 0700);
    file_write("deep/in.md", "In.\n");
    file_write("outside.md", "Outside.\n");
    is_refused("/etc/passwd", "only .md");
    is_refused("none.md", "none.md is not included: No such file");
    is_refused("deep", "only .md");
    is_refused("/etc/a.md", elsewhere);
    is_refused("../a.md", elsewhere);
    is_refused("deep/../../a.md", elsewhere);
    is_refused("file:///etc/a.md", elsewhere);
    is_refused("https://a.b/c.md", elsewhere);
    is_refused("bad.md", "includes itself");
    is_refused("./deep/.//.md", "No such file");
    /* links that lead out of the folder, or to what is no file */
    char target[220];
    snprintf(target, sizeof target, "%s", path_of("outside.md"));
    assert_int_equal(symlink(target, path_of("deep/out.md")), 0);
    assert_int_equal(symlink("/etc", path_of("deep/etc")), 0);
    assert_int_equal(symlink("/etc/passwd", path_of("deep/host.md")), 0);
    assert_int_equal(mkdir(path_of("deep/folder.md"), 0700), 0);
    assert_int_equal(mkfifo(path_of("deep/pipe.md"), 0600), 0);
    is_refused("deep/host.md", elsewhere);
    is_refused("deep/etc/a.md", "No such file");
    is_refused("deep/folder.md", "");
    is_refused("deep/pipe.md", "");
    /* the folder is the named file's: a link that stays in it is none that leads out */
    file_write("good.md", "[x](deep/out.md \"include\")\n");
    struct read r = read_now("good.md");
    assert_string_equal(r.document->plain, "Outside.\n\n");
    read_end(&r);
    file_write("deep/bad.md", "[x](out.md \"include\")\n");
    r = read_now("deep/bad.md");
    assert_int_equal(r.files.refused_count, 1);
    assert_non_null(strstr(r.files.refused[0], elsewhere));
    read_end(&r);
    assert_int_equal(read_try(&r, "-"), READER_OK);
    assert_string_equal(r.files.refused[0],
                        "-:1: b.md is not included: what is piped in includes no files");
    read_end(&r);
}

static void circles_end(void **state)
{
    (void)state;
    char text[100], name[40];
    file_write("one.md", "One.\n\n[x](two.md \"include\")\n");
    file_write("two.md", "Two.\n\n[x](one.md \"include\")\n\n[x](./two.md \"include\")\n");
    struct read r = read_now("one.md");
    assert_string_equal(r.document->plain, "One.\n\nTwo.\n\nx\n\nx\n\n");
    assert_int_equal(r.files.refused_count, 2);
    assert_non_null(
        strstr(r.files.refused[0], "two.md:3: one.md is not included: it includes"));
    assert_non_null(strstr(r.files.refused[1], "two.md:5: "));
    read_end(&r);
    for (int i = 0; i < 12; i++) {
        snprintf(name, sizeof name, "d%d.md", i);
        snprintf(text, sizeof text, "D%d.\n\n[x](d%d.md \"include\")\n", i, i + 1);
        file_write(name, text);
    }
    r = read_now("d0.md");
    assert_int_equal(r.files.count, 1 + READER_INCLUDES_DEPTH_MAX);
    assert_non_null(strstr(r.files.refused[0], "d8.md:3: d9.md is not included: files include "
                                               "each other up to 8 deep"));
    read_end(&r);
}

/* Few small files that would become a billion. */
static void bombs_are_small(void **state)
{
    (void)state;
    char name[40];
    for (int i = 0; i < 8; i++) {
        char text[12000] = "a\n\n";
        for (int k = 0; k < 200; k++)
            snprintf(text + strlen(text), 60, "[x](b%d.md \"include\")\n\n", i + 1);
        snprintf(name, sizeof name, "b%d.md", i);
        file_write(name, text);
    }
    file_write("b8.md", "end\n");
    struct read r = read_now("b0.md");
    assert_int_equal(r.files.count, READER_FILES_MAX);
    assert_int_equal(r.files.refused_count, READER_REFUSED_MAX);
    assert_true(r.files.refused_all > READER_REFUSED_MAX);
    assert_non_null(strstr(r.files.refused[0], "up to 1000 files"));
    read_end(&r);
}

static void wrong_files_are_named(void **state)
{
    (void)state;
    struct read r;
    char line[300];
    FILE *file = fopen(path_of("hard.md"), "w");
    assert_non_null(file);
    for (int i = 0; i < 300000; i++)
        fputs("a@", file);
    fclose(file);
    file_write("with.md", "[x](hard.md \"include\")\n");
    file_write("empty.md", "");
    file_write("without.md", "[x](empty.md \"include\")\n");
    assert_int_equal(read_try(&r, path_of("with.md")), READER_TOO_LARGE);
    snprintf(line, sizeof line, "%s: line 1: ", path_of("hard.md"));
    assert_memory_equal(reader_error(), line, strlen(line));
    read_end(&r);
    r = read_now("without.md");
    assert_string_equal(r.document->plain, "x\n\n");
    read_end(&r);
}

static int begin(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int end(void **state)
{
    char command[100];
    (void)state;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(references_lead_to_other_files),
                                       cmocka_unit_test(files_stand_in_their_places),
                                       cmocka_unit_test(includes_are_what_they_say),
                                       cmocka_unit_test(files_elsewhere_are_refused),
                                       cmocka_unit_test(circles_end),
                                       cmocka_unit_test(bombs_are_small),
                                       cmocka_unit_test(wrong_files_are_named)};
    if (without_library())
        return 77;
    return cmocka_run_group_tests(tests, begin, end);
}
