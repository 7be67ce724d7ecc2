/* html_tags.h - reads HTML as strictly as a test wants it: each tag that is opened is closed by
 * its own, attributes are quoted, and nothing else has a sign < in it. */
#ifndef HTML_TAGS_H
#define HTML_TAGS_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { HTML_DEEP = 200, HTML_NAME = 16 };

static inline size_t html_name(const char *at, char name[HTML_NAME])
{
    const size_t n = strspn(at, "abcdefghijklmnopqrstuvwxyz0123456789");
    if (n == 0 || n >= HTML_NAME)
        return 0;
    memcpy(name, at, n);
    name[n] = '\0';
    return n;
}

/* Behind a tag's attributes; NULL: they are not as they must be. */
static inline const char *html_attributes(const char *at, bool *closed)
{
    *closed = false;
    while (*at == ' ') {
        at += 1 + strspn(at + 1, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-");
        if (at[0] != '=' || at[1] != '"' || !(at = strchr(at + 2, '"')))
            return NULL;
        at++;
    }
    if (*at == '/') {
        *closed = true;
        at++;
    }
    return *at == '>' ? at + 1 : NULL;
}

/* NULL: all is well; else from where it is not. */
static inline const char *html_wrong(const char *html)
{
    static const char *const void_tags[] = {"meta", "img", "hr", "br", NULL};
    char open[HTML_DEEP][HTML_NAME];
    int deep = 0;
    const char *at = html;
    if (strncmp(at, "<!DOCTYPE html>", 15) != 0)
        return at;
    for (at += 15; (at = strchr(at, '<'));) {
        const char *const tag = at;
        char name[HTML_NAME];
        const bool ends = at[1] == '/';
        const size_t n = html_name(at + 1 + ends, name);
        bool closed = false, empty = false;
        if (n == 0)
            return tag;
        at = html_attributes(at + 1 + ends + n, &closed);
        if (!at)
            return tag;
        for (int i = 0; void_tags[i]; i++)
            empty = empty || strcmp(name, void_tags[i]) == 0;
        if (ends) {
            if (deep == 0 || strcmp(open[--deep], name) != 0)
                return tag;
        } else if (!closed && !empty) {
            if (deep == HTML_DEEP)
                return tag;
            strcpy(open[deep++], name);
        }
        if (strcmp(name, "style") == 0 && !ends && !(at = strstr(at, "</style>")))
            return tag;
    }
    return deep ? html : NULL;
}

/* What stands between tags of a body, without what readers left. The caller frees it. */
static inline char *html_words(const char *html)
{
    static const char *const left[][2] = {{"<aside class=\"remark\"", "</aside>"},
                                          {"<a class=\"sign\"", "</a>"},
                                          {"<span class=\"ink\"", "</span>"}};
    char *words = malloc(strlen(html) + 1), *to = words;
    const char *at = strstr(html, "<body>");
    while (words && at && *at) {
        const char *before = at;
        for (size_t i = 0; i < sizeof left / sizeof *left; i++)
            if (strncmp(at, left[i][0], strlen(left[i][0])) == 0 && strstr(at, left[i][1]))
                at = strstr(at, left[i][1]) + strlen(left[i][1]);
        if (at != before)
            continue;
        if (*at == '<')
            at = strchr(at, '>') ? strchr(at, '>') + 1 : "";
        else if (*at == '\n')
            at++;
        else
            *to++ = *at++;
    }
    if (words)
        *to = '\0';
    return words;
}

#endif
