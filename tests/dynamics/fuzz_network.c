/* fuzz_network.c - reads networks and clamps from damaged text. Each is read, or refused with
 * one line. A network that is read moves without exploding, and is written and read again as
 * the same text. (security.md 29) */
#include <clamps.h>
#include <network_file.h>
#include <step.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static char *text_of(const struct dyn_network *n, size_t *count)
{
    char *text = NULL;
    FILE *to = open_memstream(&text, count);
    if (!to || dyn_network_print(n, to) != DYN_OK || fclose(to) != 0)
        abort();
    return text;
}

static void moves(struct dyn_network *n)
{
    if (dyn_network_world(n)->integrator == DYN_THESIS)
        return; /* it may explode */
    if (dyn_network_step(n, 1.0 / 60, 2) != DYN_OK)
        abort();
    for (int i = 0; i < dyn_masses_count(n); i++) {
        const struct dyn_state *s = &dyn_network_states(n)[i];
        if (!(fabs(s->x) <= 1e6 && fabs(s->y) <= 1e6))
            abort();
    }
}

static void refused(const void *out)
{
    if (out || !*dyn_error() || strchr(dyn_error(), '\n'))
        abort();
}

static void clamps_look(const char *text, size_t count)
{
    struct dyn_clamps *c;
    struct dyn_network *n;
    struct dyn_mass mass = dyn_mass_usual();
    if (dyn_clamps_parse(text, count, "fuzz", &c) != DYN_OK) {
        refused(c);
        return;
    }
    if (dyn_network_create(&n) != DYN_OK)
        abort();
    for (int i = 0; i < 4; i++)
        if (dyn_mass_add(n, &mass, NULL) != DYN_OK)
            abort();
    (void)dyn_clamps_step(c, n, 0.25, 8);
    for (int i = 0; i < 4; i++)
        if (!(fabs(dyn_network_states(n)[i].x) <= 1e6))
            abort();
    dyn_network_destroy(n);
    dyn_clamps_destroy(c);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    struct dyn_network *n, *again;
    char *text = malloc(count + 1); /* sanitizers see a read beyond its end */
    if (!text)
        abort();
    memcpy(text, bytes, count);
    clamps_look(text, count);
    enum dyn_status status = dyn_network_parse(text, count, "fuzz", &n);
    free(text);
    if (status != DYN_OK) {
        refused(n);
        return 0;
    }
    size_t count_n, count_again;
    char *text_n = text_of(n, &count_n);
    if (dyn_network_parse(text_n, count_n, "again", &again) != DYN_OK)
        abort();
    char *text_again = text_of(again, &count_again);
    if (count_n != count_again || memcmp(text_n, text_again, count_n) != 0)
        abort();
    free(text_n);
    free(text_again);
    moves(n);
    dyn_network_destroy(n);
    dyn_network_destroy(again);
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "../sample.h"

/* Without libFuzzer: good texts, each damaged in many ways, the same in every run. */
int main(void)
{
    static const char *const seeds[] = {
        "springs 1\ntime_s 1.5\ncontrol gravity 3\ncontrol integrator verlet\ncontrol rest "
        "2\nmass "
        "x=1 y=2 stuck\nmass x=3 mass=2 drag=1\nspring 0 1 constant=10 damping=3\npull 1 2 3 4 "
        "5\nend\n",
        "springs 1\r\n# c\nmass vx=-4 vy=5 held\nmass x=1 restitution=0.3 friction=2\nmass y=1 "
        "gravity=-1\nspring 1 2 rest_length=0.5 breaking_strain=0.01\nspring 0 2 "
        "broken\ncontrol floor_on off\ncontrol left 0.5\ncontrol left_on on\nend\n",
        "clamps 1\nkey 0 0 1 2\nkey 0 0.5 2 2\nkey 0 1e0 3 2.5\nfree 0 1.25\nkey 3 -1 4 4\nkey "
        "3 9 "
        "-4 1e3\nend\n",
    };
    enum { ROUNDS = 20000, MOST = 700 };
    uint8_t bytes[MOST];
    uint64_t state = 19;
    int read = 0;
    for (int i = 0; i < ROUNDS; i++) {
        const char *seed = seeds[i % 3];
        size_t count = strlen(seed);
        memcpy(bytes, seed, count);
        for (uint64_t changes = 1 + sample_word(&state) % 4; changes > 0; changes--) {
            size_t at = sample_word(&state) % count, from = sample_word(&state) % count;
            switch (sample_word(&state) % 5) {
            case 0:
                bytes[at] = (uint8_t)sample_word(&state);
                break;
            case 1: /* one from elsewhere */
                bytes[at] = bytes[from];
                break;
            case 2: /* cut out */
                memmove(bytes + at, bytes + at + 1, count - at - 1);
                count -= count > 4;
                break;
            case 3: /* another digit */
                bytes[at] = bytes[at] >= '0' && bytes[at] <= '9'
                                ? (uint8_t)('0' + sample_word(&state) % 10)
                                : bytes[at];
                break;
            default: /* doubled */
                if (count < MOST) {
                    memmove(bytes + at + 1, bytes + at, count - at);
                    count++;
                }
            }
        }
        LLVMFuzzerTestOneInput(bytes, count);
        struct dyn_network *n;
        read += dyn_network_parse((const char *)bytes, count, "fuzz", &n) == DYN_OK;
        dyn_network_destroy(n);
    }
    return read > ROUNDS / 30 ? 0 : 1; /* enough of them are read, too */
}
#endif
