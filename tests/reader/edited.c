/* edited.c - see edited.h. */
/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include "edited.h"

#include <stdio.h>
#include <string.h>

static void document_read(struct edited *e, const struct reader_bytes *texts, int count)
{
    *e = (struct edited){.files = {.keep = true}};
    assert_int_equal(reader_document_create(&e->document), READER_OK);
    for (int i = 0; i < count; i++)
        if (reader_files_add(&e->files, e->document, i ? "two.md" : "one.md", texts[i].text,
                             texts[i].bytes) != READER_OK)
            fail_msg("%s", reader_error());
    assert_int_equal(reader_document_refer(e->document), READER_OK);
    assert_int_equal(reader_document_plain(e->document), READER_OK);
}

void edited_begin(struct edited *e, const char *one, const char *two)
{
    const struct reader_bytes texts[] = {{(char *)(uintptr_t)one, strlen(one)},
                                         {(char *)(uintptr_t)two, two ? strlen(two) : 0}};
    document_read(e, texts, two ? 2 : 1);
    assert_int_equal(reader_edit_create(&e->document, &e->files, NULL, &e->edit), READER_OK);
}

void edited_end(struct edited *e)
{
    reader_edit_destroy(e->edit);
    reader_remarks_close(e->remarks);
    reader_document_destroy(e->document);
    reader_files_finish(&e->files);
}

/* ---- the slow twin ---- */

static void blocks_same(const struct reader_block *a, const struct reader_block *b, int count)
{
    for (int i = 0; i < count; i++) {
        assert_int_equal(a[i].kind, b[i].kind);
        assert_int_equal(a[i].align, b[i].align);
        assert_true(reader_asked_same(&a[i].asked, &b[i].asked));
        assert_true(reader_beside_same(&a[i].beside, &b[i].beside));
        assert_string_equal(a[i].text, b[i].text);
        assert_int_equal(a[i].bytes, b[i].bytes);
        assert_int_equal(a[i].at, b[i].at);
        assert_int_equal(a[i].source, b[i].source);
        assert_int_equal(a[i].first_line, b[i].first_line);
        assert_int_equal(a[i].last_line, b[i].last_line);
        assert_int_equal(a[i].items, b[i].items);
        assert_int_equal(a[i].quotes, b[i].quotes);
        assert_int_equal(a[i].level, b[i].level);
        assert_int_equal(a[i].number, b[i].number);
        assert_int_equal(a[i].continues, b[i].continues);
        assert_string_equal(a[i].marker ? a[i].marker : "", b[i].marker ? b[i].marker : "");
        assert_string_equal(a[i].target ? a[i].target : "", b[i].target ? b[i].target : "");
        assert_int_equal(a[i].head, b[i].head);
        assert_int_equal(a[i].columns, b[i].columns);
        if (a[i].kind == READER_ROW) {
            assert_int_equal(a[i].table, b[i].table);
            assert_memory_equal(a[i].aligns, b[i].aligns, sizeof a[i].aligns);
        }
        assert_int_equal(a[i].spans_count, b[i].spans_count);
        for (int k = 0; k < a[i].spans_count; k++) {
            const struct reader_span *s = &a[i].spans[k], *t = &b[i].spans[k];
            assert_int_equal(s->begin, t->begin);
            assert_int_equal(s->end, t->end);
            assert_int_equal(s->look, t->look);
            assert_int_equal(s->note, t->note);
            assert_true(reader_asked_same(&s->asked, &t->asked));
            assert_string_equal(s->target ? s->target : "", t->target ? t->target : "");
        }
    }
}

void as_from_scratch(const struct edited *e)
{
    struct edited twin;
    document_read(&twin, e->files.texts, e->files.count);
    assert_int_equal(e->document->plain_bytes, twin.document->plain_bytes);
    assert_string_equal(e->document->plain, twin.document->plain);
    assert_int_equal(e->document->blocks_count, twin.document->blocks_count);
    assert_int_equal(e->document->note_blocks_count, twin.document->note_blocks_count);
    blocks_same(e->document->blocks, twin.document->blocks, e->document->blocks_count);
    blocks_same(e->document->note_blocks, twin.document->note_blocks,
                e->document->note_blocks_count);
    assert_int_equal(e->document->tables_count, twin.document->tables_count);
    assert_int_equal(e->document->labels_count, twin.document->labels_count);
    for (int i = 0; i < twin.document->labels_count; i++) {
        const struct reader_label *l = &e->document->labels[i], *m = &twin.document->labels[i];
        assert_string_equal(l->name, m->name);
        assert_int_equal(l->source, m->source);
        assert_int_equal(l->block, m->block);
        assert_int_equal(l->first, m->first);
    }
    assert_int_equal(e->document->lost_count, twin.document->lost_count);
    for (int i = 0; i < twin.document->lost_count; i++)
        assert_int_equal(e->document->lost[i].line, twin.document->lost[i].line);
    edited_end(&twin);
}

/* The first place of `at`, with | where the caret is. */
size_t caret_at(const struct edited *e, const char *at)
{
    const char *bar = strchr(at, '|');
    char words[200];
    snprintf(words, sizeof words, "%.*s%s", (int)(bar - at), at, bar + 1);
    const char *found = strstr(e->document->plain, words);
    assert_non_null(found);
    return (size_t)(found - e->document->plain) + (size_t)(bar - at);
}
