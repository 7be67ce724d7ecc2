/* numbers.c - see numbers.h. */
#include "codegen/numbers.h"

#include <stdlib.h>
#include <string.h>

#include "codegen/text.h"

enum { NUMBERS_MOST = 32 };

void numbers_write(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++)
        if (*from == '\1')
            from++; /* the letter, too */
        else if (*from != '\2' && *from != '\3')
            *to++ = *from;
    *to = '\0';
}

static const char *type_of(char letter)
{
    return letter == 'i' ? "int" : letter == 'u' ? "uint" : "ulong";
}

/* Reads the numbers. Returns how many; more than NUMBERS_MOST: too many. */
static int numbers_find(const char *text, struct kernel_argument *out)
{
    int count = 0;
    for (const char *at = strchr(text, '\1'); at; at = strchr(at + 1, '\1')) {
        if (count < NUMBERS_MOST)
            out[count] = (struct kernel_argument){
                .kind = ARGUMENT_NUMBER,
                .size = at[1] == 'l' ? 8 : 4,
                .number = at[1] == 'i' ? (uint64_t)strtoll(at + 2, NULL, 0)
                                       : strtoull(at + 2, NULL, 0)};
        count++;
    }
    return count;
}

static void text_add(struct text *t, const char *from, size_t length)
{
    text_put(t, "%.*s", (int)length, from);
}

/* The text with names in place of numbers, and their declarations. */
static char *text_lift(const char *text)
{
    struct text t = {0}, parameters = {0};
    int count = 0;
    text_put(&parameters, "%s", "");
    for (const char *at = strchr(text, '\1'); at; at = strchr(at + 1, '\1'))
        text_put(&parameters, ", %s n%d", type_of(at[1]), count++);
    count = 0;
    for (const char *from = text;;) {
        size_t length = strcspn(from, "\1\3");
        text_add(&t, from, length);
        from += length;
        if (!*from)
            break;
        if (*from == '\1') {
            text_put(&t, "n%d", count++);
            from = strchr(from, '\2');
        } else {
            text_put(&t, "%s", parameters.data ? parameters.data : "");
        }
        from++;
    }
    bool failed = t.failed || parameters.failed;
    free(parameters.data);
    if (failed) {
        free(t.data);
        return NULL;
    }
    return t.data;
}

char *numbers_lift(const struct kernel_text *k, struct kernel_argument **arguments,
                   int *arguments_count)
{
    struct kernel_argument numbers[NUMBERS_MOST];
    int count = numbers_find(k->text, numbers);
    if (!count || count > NUMBERS_MOST || !strchr(k->text, '\3'))
        return NULL;
    size_t before = (size_t)k->arguments_count;
    char *text = text_lift(k->text);
    *arguments = text ? malloc((before + (size_t)count) * sizeof **arguments) : NULL;
    if (!*arguments) {
        free(text);
        return NULL;
    }
    if (before)
        memcpy(*arguments, k->arguments, before * sizeof **arguments);
    memcpy(*arguments + before, numbers, (size_t)count * sizeof *numbers);
    *arguments_count = (int)before + count;
    return text;
}
