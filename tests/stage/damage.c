/* damage.c - see damage.h. */
#include "damage.h"

#include <string.h>

#include "../sample.h"

static size_t line_cut(char *text, size_t count, size_t at)
{
    char *end = memchr(text + at, '\n', count - at);
    size_t next = end ? (size_t)(end + 1 - text) : count;
    memmove(text + at, text + next, count - next);
    return count - (next - at);
}

size_t damage(const char *text, uint64_t number, char out[DAMAGE_MOST])
{
    uint64_t state = sample_mixed(number + 1);
    size_t count = strlen(text);
    memcpy(out, text, count);
    for (uint64_t changes = sample_word(&state) % 4; changes > 0 && count > 0; changes--) {
        size_t at = sample_word(&state) % count, from = sample_word(&state) % count;
        switch (sample_word(&state) % 6) {
        case 0:
            out[at] = (char)sample_word(&state);
            break;
        case 1:
            out[at] = out[from];
            break;
        case 2:
            memmove(out + at, out + at + 1, count - at - 1);
            count--;
            break;
        case 3:
            if (out[at] >= '0' && out[at] <= '9')
                out[at] = (char)('0' + sample_word(&state) % 10);
            break;
        case 4:
            count = line_cut(out, count, at);
            break;
        default:
            if (count + (count - at) <= DAMAGE_MOST) {
                memmove(out + at + 1, out + at, count - at);
                count++;
            }
        }
    }
    return count;
}
