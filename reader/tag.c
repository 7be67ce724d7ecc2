/* tag.c - the tags of HTML that are read: see reader_internal.h. */
#include "reader_internal.h"

#include <string.h>
#include <strings.h>

const char *reader_tag_label(const char *tag, size_t *bytes)
{
    const char *at = strncmp(tag, "<a ", 3) == 0 ? tag + 3 + strspn(tag + 3, " \n") : "";
    at += strncmp(at, "id=", 3) == 0 ? 3 : strncmp(at, "name=", 5) == 0 ? 5 : strlen(at);
    const char quote = *at == '"' || *at == '\'' ? *at++ : '\0';
    *bytes = strcspn(at, " \t\n\"'<>=`#");
    const char *end = at + *bytes;
    if (quote && *end++ != quote)
        return NULL;
    end += strspn(end, " \n");
    return *bytes >= 1 && *bytes <= READER_LABEL_BYTES && strcmp(end, ">") == 0 ? at : NULL;
}

const char *reader_tag_break(const char *text)
{
    const char *at = text + 3;
    if (strncasecmp(text, "<br", 3) != 0)
        return text;
    at += strspn(at, " \t");
    at += *at == '/';
    return *at == '>' ? at + 1 : text;
}
