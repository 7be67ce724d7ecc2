/* fuzz_events.c - decodes random bytes as the arguments of an event. An event that is decoded
 * encodes to the same bytes. `fuzz_events ROUNDS` */
#include "wind.h"

#include <stdio.h>
#include <string.h>

static uint64_t state = 1990;

static uint64_t chance(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

int main(int argc, char **argv)
{
    long rounds = argc > 1 ? strtol(argv[1], NULL, 10) : 100000, decoded = 0;
    static const double leaves[4] = {1, 2, 3, 4};
    for (long round = 0; round < rounds; round++) {
        struct wind wind = {.height = 3, .leaves_count = (int)(chance() % 5), .leaves = leaves};
        struct event_bytes b = {0}, again = {0};
        void *back;
        event_encode(&b, &wind_kind, &wind, NULL);
        for (uint64_t i = chance() % 4; i > 0; i--)
            b.at[chance() % b.count] = (uint8_t)chance();
        size_t count = chance() % 8 ? b.count : chance() % (b.count + 1);
        uint8_t *exact = malloc(count ? count : 1); /* exact: finds reads beyond it */
        if (!exact)
            return 1;
        memcpy(exact, b.at, count);
        if (event_decode(exact, count, &wind_kind, NULL, &back) == EVENT_DECODED) {
            decoded++;
            event_encode(&again, &wind_kind, back, NULL);
            exact[40] = again.at[40]; /* any byte but 0 is true */
            if (again.count != count || memcmp(again.at, exact, count) != 0) {
                fprintf(stderr, "round %ld: other bytes come back\n", round);
                return 1;
            }
            event_free(&wind_kind, back);
        }
        free(again.at);
        free(exact);
        free(b.at);
    }
    printf("%ld of %ld decoded\n", decoded, rounds);
    return decoded == 0;
}
