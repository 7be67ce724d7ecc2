/* words.c - where words may be divided, by libhyphen and the dictionaries of the system; and
 * where words of Thai end, by libthai. Both libraries are loaded when they are first needed:
 * most programs divide no words. */
#include "page_internal.h"

#include <library.h>
#include <linebreak.h>
#include <locale.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <wctype.h>

#include <hyphen.h>
#include <thai/thwbrk.h>

/* ---- the libraries ---- */

static struct {
    bool tried, there;
    __typeof__(&hnj_hyphen_load) hnj_hyphen_load;
    __typeof__(&hnj_hyphen_free) hnj_hyphen_free;
    __typeof__(&hnj_hyphen_hyphenate2) hnj_hyphen_hyphenate2;
} hyphen;
static const struct library_function hyphen_functions[] = {
    LIBRARY_FUNCTION(hyphen, hnj_hyphen_load), LIBRARY_FUNCTION(hyphen, hnj_hyphen_free),
    LIBRARY_FUNCTION(hyphen, hnj_hyphen_hyphenate2)};

static struct {
    __typeof__(&th_brk_new) th_brk_new;
    __typeof__(&th_brk_delete) th_brk_delete;
    __typeof__(&th_brk_wc_find_breaks) th_brk_wc_find_breaks;
} thai;
static const struct library_function thai_functions[] = {
    LIBRARY_FUNCTION(thai, th_brk_new), LIBRARY_FUNCTION(thai, th_brk_delete),
    LIBRARY_FUNCTION(thai, th_brk_wc_find_breaks)};

/* Under the dictionaries' lock. */
static bool hyphen_load(void)
{
    const char *missing;
    if (!hyphen.tried)
        hyphen.there =
            library_load("libhyphen.so.0", hyphen_functions,
                         sizeof hyphen_functions / sizeof *hyphen_functions, &hyphen, &missing);
    hyphen.tried = true;
    return hyphen.there;
}

/* ---- dictionaries, each loaded once ---- */

enum { LANGUAGES_MAX = 32, WORD_MAX = 100, LEAST_LETTERS = 5 };

static struct {
    char language[16];
    HyphenDict *patterns; /* NULL: there are none */
} dictionaries[LANGUAGES_MAX];
static int dictionaries_count;
static pthread_mutex_t dictionaries_lock = PTHREAD_MUTEX_INITIALIZER;

/* "en" has hyph_en_US.dic where there is no hyph_en.dic; "de-AT" hyph_de_AT.dic, else
 * hyph_de.dic or hyph_de_DE.dic. */
static HyphenDict *patterns_load(const char *language)
{
    static const char *const usual[] = {"en_US", "de_DE", "fr_FR", "es_ES", "it_IT", "pt_PT"};
    char names[3][80], two[3] = {language[0], language[0] ? language[1] : '\0', '\0'};
    snprintf(names[0], sizeof names[0], "/usr/share/hyphen/hyph_%.8s.dic", language);
    for (char *at = names[0] + strlen("/usr/share/hyphen/hyph_"); *at && *at != '.'; at++)
        *at = *at == '-' ? '_' : *at;
    snprintf(names[1], sizeof names[1], "/usr/share/hyphen/hyph_%s.dic", two);
    names[2][0] = '\0';
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++)
        if (strncmp(usual[i], two, 2) == 0)
            snprintf(names[2], sizeof names[2], "/usr/share/hyphen/hyph_%s.dic", usual[i]);
    for (int i = 0; i < 3; i++) {
        struct stat about;
        if (names[i][0] && stat(names[i], &about) == 0 && S_ISREG(about.st_mode))
            return hyphen_load() ? hyphen.hnj_hyphen_load(names[i]) : NULL;
    }
    return NULL;
}

static HyphenDict *patterns_of(const char *language)
{
    HyphenDict *found = NULL;
    pthread_mutex_lock(&dictionaries_lock);
    int i = 0;
    while (i < dictionaries_count && strncmp(dictionaries[i].language, language,
                                             sizeof dictionaries[i].language - 1) != 0)
        i++;
    if (i == dictionaries_count && i < LANGUAGES_MAX) {
        snprintf(dictionaries[i].language, sizeof dictionaries[i].language, "%s", language);
        dictionaries[i].patterns = patterns_load(language);
        dictionaries_count++;
    }
    if (i < dictionaries_count)
        found = dictionaries[i].patterns;
    pthread_mutex_unlock(&dictionaries_lock);
    return found;
}

bool page_language_divides(const char *language)
{
    return patterns_of(language ? language : "en") != NULL;
}

static locale_t lower_locale(void)
{
    static locale_t locale;
    pthread_mutex_lock(&dictionaries_lock);
    if (!locale)
        locale = newlocale(LC_CTYPE_MASK, "C.UTF-8", (locale_t)0);
    pthread_mutex_unlock(&dictionaries_lock);
    return locale;
}

/* Divides the word of letters begin..end. */
static void word_divide(HyphenDict *patterns, struct paragraph *p, int begin, int end)
{
    char word[3 * WORD_MAX + FONT_UTF8_BYTES], hyphens[3 * WORD_MAX + 6];
    int bytes = 0, ends[WORD_MAX]; /* of each letter, its last byte */
    locale_t locale = lower_locale();
    if (end - begin < LEAST_LETTERS || end - begin > WORD_MAX)
        return;
    for (int i = begin; i < end; i++) {
        uint32_t c = p->characters[i];
        uint32_t small = locale && c < 0x10000 ? (uint32_t)towlower_l((wint_t)c, locale) : c;
        if (small > 0xffff)
            return;
        bytes += font_utf8_put(small, word + bytes);
        ends[i - begin] = bytes - 1;
    }
    word[bytes] = '\0';
    char **others = NULL;
    int *places = NULL, *cuts = NULL;
    if (hyphen.hnj_hyphen_hyphenate2(patterns, word, bytes, hyphens, NULL, &others, &places,
                                     &cuts))
        return;
    /* Dictionaries of UTF-8 count characters, others bytes; what is spelled otherwise when
     * divided stays whole. */
    for (int i = 0; i + 1 < end - begin; i++) {
        int at = patterns->utf8 ? i : ends[i];
        struct letter *l = &p->letters[begin + i];
        if ((hyphens[at] & 1) && !(others && others[at]) && l[1].cluster)
            l->hyphen = true;
    }
    for (int i = 0; others && i < bytes; i++)
        free(others[i]);
    free(others);
    free(places);
    free(cuts);
}

static bool is_letter(uint32_t c)
{
    hb_unicode_general_category_t category =
        hb_unicode_general_category(hb_unicode_funcs_get_default(), c);
    return (category >= HB_UNICODE_GENERAL_CATEGORY_LOWERCASE_LETTER &&
            category <= HB_UNICODE_GENERAL_CATEGORY_UPPERCASE_LETTER) ||
           font_text_mark(c);
}

static void words_divide(struct page_text *t, struct paragraph *p, int begin, int to)
{
    for (int i = begin; i < to;) {
        int end = i;
        while (end < to && is_letter(p->characters[end]))
            end++;
        if (end > i) {
            const char *language = t->styles[p->letters[i].style]->language;
            HyphenDict *patterns = patterns_of(language ? language : "en");
            /* A word that has a sign for where to divide it is divided there alone. */
            bool signs = (i > 0 && p->characters[i - 1] == 0xad) ||
                         (end < p->count && p->characters[end] == 0xad);
            if (patterns && !signs)
                word_divide(patterns, p, i, end);
        }
        i = end > i ? end : i + 1;
    }
}

void words_hyphenate(struct page_text *t, struct paragraph *p)
{
    if (p->hyphenated || !p->manner.hyphenate)
        return;
    p->hyphenated = true;
    words_divide(t, p, 0, p->count);
}

void words_hyphenate_again(struct page_text *t, struct paragraph *p, int *begin, int *end)
{
    if (!p->hyphenated)
        return;
    *begin -= *begin > 0; /* a sign for where to divide is of the words on both sides */
    *end += *end < p->count;
    /* To the ends of words; not of those that are too long to be divided, and were before. */
    for (int n = 0; n <= WORD_MAX && *begin > 0 && is_letter(p->characters[*begin - 1]); n++)
        --*begin;
    for (int n = 0; n <= WORD_MAX && *end < p->count && is_letter(p->characters[*end]); n++)
        ++*end;
    for (int i = *begin; i < *end; i++)
        p->letters[i].hyphen = false;
    words_divide(t, p, *begin, *end);
}

/* ---- Thai ---- */

static pthread_once_t thai_once = PTHREAD_ONCE_INIT;
static ThBrk *thai_breaker; /* reads a file; kept to the end */

static void thai_begin(void)
{
    const char *missing;
    if (library_load("libthai.so.0", thai_functions,
                     sizeof thai_functions / sizeof *thai_functions, &thai, &missing))
        thai_breaker = thai.th_brk_new(NULL);
}

static void thai_end(void) __attribute__((destructor));
static void thai_end(void)
{
    if (thai_breaker)
        thai.th_brk_delete(thai_breaker);
    for (int i = 0; i < dictionaries_count; i++)
        if (dictionaries[i].patterns)
            hyphen.hnj_hyphen_free(dictionaries[i].patterns);
}

void words_thai(struct paragraph *p)
{
    for (int i = 0; i < p->count;) {
        int end = i;
        while (end < p->count && p->characters[end] >= 0xe01 && p->characters[end] <= 0xe5b)
            end++;
        if (end > i) {
            pthread_once(&thai_once, thai_begin);
            thwchar_t *word = calloc((size_t)(end - i) + 1, sizeof *word);
            int *places = calloc((size_t)(end - i) + 1, sizeof *places);
            for (int k = i; word && k < end; k++)
                word[k - i] = (thwchar_t)p->characters[k];
            int count =
                word && places && thai_breaker
                    ? thai.th_brk_wc_find_breaks(thai_breaker, word, places, (size_t)(end - i))
                    : 0;
            for (int k = i; count > 0 && k + 1 < end;
                 k++) /* not where another has found words */
                p->letters[k].brk = LINEBREAK_NOBREAK;
            for (int k = 0; k < count; k++)
                if (places[k] > 0 && places[k] < end - i && p->letters[i + places[k]].cluster)
                    p->letters[i + places[k] - 1].brk = LINEBREAK_ALLOWBREAK;
            free(word);
            free(places);
        }
        i = end > i ? end : i + 1;
    }
}
