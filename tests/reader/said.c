/* said.c - see said.h. */
#include "said.h"

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <stdio.h>
#include <string.h>

struct reader_document *read_all(const char *text, size_t bytes)
{
    struct reader_document *d;
    assert_int_equal(reader_document_create(&d), READER_OK);
    if (reader_document_add(d, text, bytes) != READER_OK)
        fail_msg("%s", reader_error());
    return d;
}

/* ---- a block in words ---- */

struct words {
    char text[4096];
    size_t used;
};

static void say(struct words *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(struct words *w, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = vsnprintf(w->text + w->used, sizeof w->text - w->used, format, args);
    va_end(args);
    assert_true(n >= 0 && w->used + (size_t)n < sizeof w->text);
    w->used += (size_t)n;
}

static void block_say(struct words *w, const struct reader_block *b)
{
    static const char *const kinds[] = {"p",    "h",   "code", "live",   "math",
                                        "rule", "row", "html", "picture"};
    say(w, "%s", kinds[b->kind]);
    if (b->kind == READER_HEADING)
        say(w, "%d", b->level);
    for (int i = 0; i < b->items; i++)
        say(w, "-");
    for (int i = 0; i < b->quotes; i++)
        say(w, ">");
    if (b->marker)
        say(w, " %s", b->marker);
    if (b->align)
        say(w, " %c", "ulcr"[b->align]);
    if (b->beside.side)
        say(w, " @%d:%d", b->beside.side, b->beside.percent);
    if (b->info)
        say(w, " (%s)", b->info);
    if (b->target)
        say(w, " <%s>", b->target);
    if (b->number)
        say(w, " #%d", b->number);
    say(w, " ");
    for (int i = 0, at = 0; i < b->spans_count; i++) {
        const struct reader_span *s = &b->spans[i];
        assert_int_equal(s->begin, at); /* in order, without gaps */
        assert_true(s->end >= s->begin && s->end <= b->bytes);
        at = s->end;
        const char *const signs[][2] = {{"*", "*"}, {"!", "!"},  {"`", "`"}, {"[", "]"},
                                        {"~", "~"}, {"^", "^"},  {"{", "}"}, {"+", "+"},
                                        {"_", "_"}, {"<|", "|>"}};
        for (int k = 0; k < 10; k++)
            if (s->look & (1u << k))
                say(w, "%s", signs[k][0]);
        say(w, "%.*s", s->end - s->begin, b->text + s->begin);
        for (int k = 9; k >= 0; k--)
            if (s->look & (1u << k))
                say(w, "%s", signs[k][1]);
        if (s->target)
            say(w, "(%s)", s->target);
    }
    say(w, "\n");
}

void blocks_are(const char *markdown, const char *expected)
{
    struct words w = {.used = 0};
    struct reader_document *d = read_all(markdown, strlen(markdown));
    assert_int_equal(reader_document_refer(d), READER_OK);
    for (int i = 0; i < d->blocks_count; i++)
        block_say(&w, &d->blocks[i]);
    for (int i = 0; i < d->notes_count; i++) {
        const struct reader_note *n = &d->notes[i];
        say(&w, "note %s:%s\n", n->class, n->name);
        for (int k = 0; k < n->blocks_count; k++)
            block_say(&w, &d->note_blocks[n->first_block + k]);
    }
    if (strcmp(w.text, expected) != 0)
        fail_msg("of\n%s\nbecame\n%s\nexpected\n%s", markdown, w.text, expected);
    reader_document_destroy(d);
}
