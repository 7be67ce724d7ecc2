/* mask.c - finds formulas in a source, and puts letters in their places that no rule of
 * Markdown looks at: see reader_internal.h. */
#include "reader_internal.h"

#include <text.h>

#include <ctype.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <wctype.h>

struct masking {
    const char *source;
    int bytes, line;
    char fence; /* of the fence that the line is in; '\0': none */
    int fence_length;
    struct reader_mask *out;
    enum reader_status status;
    locale_t utf8; /* 0: none; each letter beyond ASCII is a word's */
};

void reader_mask_finish(struct reader_mask *mask)
{
    free(mask->masked);
    free(mask->formulas);
    *mask = (struct reader_mask){0};
}

char reader_mask_letter(int formula)
{
    return (char)('a' + formula % 26);
}

static int line_end(const struct masking *m, int at)
{
    const char *end = memchr(m->source + at, '\n', (size_t)(m->bytes - at));
    return end ? (int)(end - m->source) : m->bytes;
}

static bool is_blank(const struct masking *m, int at, int end)
{
    while (at < end && (m->source[at] == ' ' || m->source[at] == '\t' ||
                        m->source[at] == '\r' || m->source[at] == '>'))
        at++;
    return at == end;
}

static int run_of(const struct masking *m, int at, int end, char c)
{
    int n = 0;
    while (at + n < end && m->source[at + n] == c)
        n++;
    return n;
}

/* Whether the line opens a fence, closes one, or is in one. */
static bool line_is_fenced(struct masking *m, int at, int end)
{
    const char *s = m->source;
    while (at < end && (strchr(" \t>", s[at]) ||
                        (strchr("-*+", s[at]) && at + 1 < end && s[at + 1] == ' ')))
        at++;
    char c = at < end ? s[at] : '\0';
    int n = c == '`' || c == '~' ? run_of(m, at, end, c) : 0;
    if (m->fence) {
        if (c == m->fence && n >= m->fence_length && is_blank(m, at + n, end))
            m->fence = '\0';
        return true;
    }
    if (n < 3 || (c == '`' && memchr(s + at + n, '`', (size_t)(end - at - n))))
        return false;
    m->fence = c;
    m->fence_length = n;
    return true;
}

/* The end of the paragraph that a place is in: before a blank line. */
static int paragraph_end(const struct masking *m, int at)
{
    for (int end = line_end(m, at); end < m->bytes; end = line_end(m, end + 1))
        if (is_blank(m, end + 1, line_end(m, end + 1)))
            return end;
    return m->bytes;
}

/* Behind the code that begins with backticks at `at`, or behind those alone. */
static int code_end(const struct masking *m, int at, int end)
{
    enum { BACKTICKS_MOST = 80 }; /* as cmark-gfm has it */
    int n = run_of(m, at, end, '`');
    for (int k = n <= BACKTICKS_MOST ? at + n : end; k < end;) {
        if (m->source[k] != '`') {
            k++;
            continue;
        }
        int closing = run_of(m, k, end, '`');
        if (closing == n)
            return k + n;
        k += closing;
    }
    return at + n;
}

/* Scripts that have no blanks between words. In them a formula stands beside letters. */
static bool is_unspaced(uint32_t c)
{
    static const uint32_t scripts[][2] = {
        {0x0e00, 0x0fff},   /* Thai, Lao, Tibetan */
        {0x1000, 0x109f},   /* Myanmar */
        {0x1780, 0x17ff},   /* Khmer */
        {0x2e80, 0xa4cf},   /* Han, kana, bopomofo, Yi */
        {0xac00, 0xd7ff},   /* Hangul: particles follow what they are of at once */
        {0xf900, 0xfaff},   /* Han */
        {0xff00, 0xffef},   /* wide forms */
        {0x1b000, 0x1b16f}, /* kana */
        {0x20000, 0x3ffff}  /* Han */
    };
    for (size_t i = 0; i < sizeof scripts / sizeof *scripts; i++)
        if (c >= scripts[i][0] && c <= scripts[i][1])
            return true;
    return false;
}

/* Whether a letter or digit begins at `at`, of a script that has blanks between words. */
static bool is_word(const struct masking *m, int at)
{
    const char *s = m->source + at;
    uint32_t c;
    if (!((unsigned char)*s & 0x80))
        return isalnum((unsigned char)*s);
    return font_utf8_next(&s, m->source + m->bytes, &c) && !is_unspaced(c) &&
           (m->utf8 ? iswalnum_l((wint_t)c, m->utf8) != 0 : true);
}

/* The same of what ends there. */
static bool is_word_before(const struct masking *m, int at)
{
    int begin = at - 1;
    while (begin > 0 && at - begin < FONT_UTF8_BYTES &&
           ((unsigned char)m->source[begin] & 0xc0) == 0x80)
        begin--;
    return at > 0 && is_word(m, begin);
}

/* The place of the dollars that end a formula whose inner begins there; -1: there are none. */
static int formula_end(const struct masking *m, int inner, int end, bool display)
{
    const char *s = m->source;
    if (end - inner > READER_FORMULA_BYTES + 2)
        end = inner + READER_FORMULA_BYTES + 2;
    for (int k = inner; k < end; k++) {
        if (s[k] == '\\') {
            k++;
        } else if (s[k] == '$' && display) {
            if (k + 1 < end && s[k + 1] == '$')
                return k > inner ? k : -1;
        } else if (s[k] == '$') {
            bool good = k > inner && !isspace((unsigned char)s[k - 1]) &&
                        (k + 1 == end || !is_word(m, k + 1));
            return good ? k : -1;
        }
    }
    return -1;
}

static void formula_mask(struct masking *m, struct reader_formula formula)
{
    struct reader_mask *out = m->out;
    if (out->formulas_count == READER_FORMULAS_MAX) {
        m->status = reader_fail(READER_TOO_LARGE,
                                "line %d: a document has up to %d formulas: part it into "
                                "several files",
                                m->line, READER_FORMULAS_MAX);
        return;
    }
    if (!array_reserve(&out->formulas, &out->formulas_capacity, out->formulas_count + 1,
                       sizeof *out->formulas)) {
        m->status = reader_fail(READER_NO_MEMORY, "no memory for a document");
        return;
    }
    out->formulas[out->formulas_count++] = formula;
    for (int k = formula.begin; k < formula.end; k++)
        if (m->source[k] != '\n' && m->source[k] != '\r')
            out->masked[k] = reader_mask_letter(out->formulas_count - 1);
    memcpy(out->masked + formula.begin, READER_MASK_SIGN, strlen(READER_MASK_SIGN));
}

/* A formula at a dollar: masks it, and returns the place behind it, or behind what is no
 * formula. */
static int dollar_take(struct masking *m, int at, int end)
{
    const char *s = m->source;
    int dollars = run_of(m, at, end, '$');
    bool display = dollars >= 2;
    int inner = at + (display ? 2 : 1);
    if (dollars > 2 || inner >= end ||
        (!display && (isspace((unsigned char)s[inner]) || is_word_before(m, at))))
        return at + dollars;
    int close = formula_end(m, inner, end, display);
    if (close < 0 || close - inner > READER_FORMULA_BYTES || (!display && close - at < 2))
        return at + dollars;
    struct reader_formula formula = {.begin = at,
                                     .end = close + (display ? 2 : 1),
                                     .inner_begin = inner,
                                     .inner_end = close,
                                     .line = m->line,
                                     .display = display};
    formula_mask(m, formula);
    for (int k = at; k < formula.end; k++)
        m->line += s[k] == '\n';
    return formula.end;
}

/* What is behind the place within its line: to the next line, or to what may begin a formula's
 * or code's end on another. */
static int rest_take(struct masking *m, int at, int end)
{
    const char *s = m->source;
    while (at < end && m->status == READER_OK) {
        if (s[at] == '\n')
            return at;
        if (s[at] == '\\') {
            at += at + 1 < end && s[at + 1] != '\n' ? 2 : 1;
        } else if (s[at] == '`') {
            int next = code_end(m, at, end);
            for (int k = at; k < next; k++)
                m->line += s[k] == '\n';
            at = next;
        } else {
            at = s[at] == '$' ? dollar_take(m, at, end) : at + 1;
        }
    }
    return at;
}

/* ---- a file's head ---- */

/* Whether a line is a word and a colon, as YAML's first. */
static bool is_key(const struct masking *m, int at, int end)
{
    const int begin = at;
    while (at < end && (isalnum((unsigned char)m->source[at]) || strchr("_-", m->source[at])))
        at++;
    return at > begin && at < end && m->source[at] == ':' &&
           (at + 1 == end || isspace((unsigned char)m->source[at + 1]));
}

/* Whether a line is three of that letter. */
static bool is_mark(const struct masking *m, int at, int end, char letter)
{
    return run_of(m, at, end, letter) == 3 && is_blank(m, at + 3, end) &&
           !memchr(m->source + at, '>', (size_t)(end - at));
}

/* Behind the lines of YAML between `---` and `---` or `...` that many programs put at the head
 * of a file of Markdown, for themselves; 0: there are none. */
static int head_end(const struct masking *m)
{
    enum { BYTES_MOST = 1 << 16 };
    int at = line_end(m, 0);
    if (!is_mark(m, 0, at, '-') || at == m->bytes || !is_key(m, at + 1, line_end(m, at + 1)))
        return 0;
    while (at < m->bytes && at < BYTES_MOST) {
        const int begin = at + 1;
        at = line_end(m, begin);
        if (is_mark(m, begin, at, '-') || is_mark(m, begin, at, '.'))
            return at;
    }
    return 0;
}

/* Its lines are blank to Markdown. */
static int head_mask(struct masking *m)
{
    const int end = head_end(m);
    for (int k = 0; k < end; k++) {
        m->line += m->source[k] == '\n';
        if (m->source[k] != '\n' && m->source[k] != '\r')
            m->out->masked[k] = ' ';
    }
    return end;
}

/* All of its source, from the head on. */
static void mask_run(struct masking *m)
{
    int paragraph = 0; /* its end, once it is known */
    for (int at = head_mask(m); at < m->bytes && m->status == READER_OK;) {
        const int end = line_end(m, at);
        const bool begins = at == 0 || m->source[at - 1] == '\n';
        if (begins && line_is_fenced(m, at, end)) {
            at = end;
        } else {
            if (paragraph <= at)
                paragraph = paragraph_end(m, at);
            at = rest_take(m, at, paragraph);
        }
        if (at < m->bytes && m->source[at] == '\n') {
            at++;
            m->line++;
        }
    }
}

static enum reader_status masking_begin(struct masking *m, const char *source, int bytes,
                                        struct reader_mask *out)
{
    *m = (struct masking){
        .source = source, .bytes = bytes, .line = 1, .out = out, .status = READER_OK};
    *out = (struct reader_mask){.masked = malloc((size_t)bytes + 1)};
    if (!out->masked)
        return reader_fail(READER_NO_MEMORY, "no memory for a document");
    m->utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", (locale_t)0);
    memcpy(out->masked, source, (size_t)bytes);
    out->masked[bytes] = '\0';
    return READER_OK;
}

enum reader_status reader_mask_make(const char *source, int bytes, struct reader_mask *out)
{
    struct masking m;
    if (masking_begin(&m, source, bytes, out) != READER_OK)
        return READER_NO_MEMORY;
    for (int k = 0; k + 1 < bytes; k++) /* what stands for formulas stands for nothing else */
        if (memcmp(source + k, READER_MASK_SIGN, 2) == 0)
            out->masked[k + 1] = (char)0x92;
    mask_run(&m);
    if (m.utf8)
        freelocale(m.utf8);
    if (m.status != READER_OK)
        reader_mask_finish(out);
    return m.status;
}

bool reader_mask_is_fenced(const char *source, int bytes)
{
    struct reader_mask mask;
    struct masking m;
    if (masking_begin(&m, source, bytes, &mask) != READER_OK)
        return true;
    mask_run(&m);
    if (m.utf8)
        freelocale(m.utf8);
    reader_mask_finish(&mask);
    return m.fence || m.status != READER_OK;
}
