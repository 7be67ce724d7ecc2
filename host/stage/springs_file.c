/* springs_file.c - saves and loads the network by dynamics, and converts its errors. */
#include "session.h"
#include "springs_internal.h"

#include <network_file.h>
#include <stdio.h>
#include <stdlib.h>

enum stage_status springs_fail(enum dyn_status status)
{
    return stage_fail(status == DYN_BAD_ARGUMENT ? STAGE_BAD_ARGUMENT
                      : status == DYN_BAD_FILE   ? STAGE_BAD_FILE
                      : status == DYN_NO_MEMORY  ? STAGE_NO_MEMORY
                                                 : STAGE_FAILED,
                      "%s", dyn_error());
}

enum stage_status springs_save(void *actor, const char *path)
{
    const struct springs *s = actor;
    enum dyn_status status = dyn_network_write(s->network, path);
    char beside[4096];
    int length = snprintf(beside, sizeof beside, "%s.clamps", path);
    if (status == DYN_OK && s->recorded && length > 0 && (size_t)length < sizeof beside)
        status = dyn_clamps_write(s->recorded, beside);
    return status == DYN_OK ? STAGE_OK : springs_fail(status);
}

/* Loads a network for the letters, which must have their masses. */
enum stage_status springs_load(void *actor, const char *path)
{
    struct springs *s = actor;
    struct dyn_network *read;
    enum dyn_status status = dyn_network_read(path, &read);
    if (status != DYN_OK)
        return springs_fail(status);
    int most = -1;
    for (int i = 0; i < s->text->letters_count; i++)
        for (int k = 0; k < 4; k++)
            most = s->text->letters[i].masses[k] > most ? s->text->letters[i].masses[k] : most;
    if (most >= dyn_masses_count(read)) {
        stage_fail(STAGE_BAD_FILE,
                   "%s: a network of %d masses is not this word's, which has %d", path,
                   dyn_masses_count(read), dyn_masses_count(s->network));
        dyn_network_destroy(read);
        return STAGE_BAD_FILE;
    }
    dyn_network_destroy(s->network);
    s->network = read;
    s->hand = (struct springs_hand){0};
    return STAGE_OK;
}

/* Of masses, of what hangs on what, and of the keys that lead masses; parameters may differ. */
uint64_t springs_digest(void *actor)
{
    const struct springs *s = actor;
    size_t masses = (size_t)dyn_masses_count(s->network), bytes = 0;
    char *text = NULL;
    uint64_t digest = stage_digest(STAGE_DIGEST_NONE, dyn_network_states(s->network),
                                   masses * sizeof(struct dyn_state));
    for (int i = 0; i < dyn_springs_count(s->network); i++) {
        struct dyn_spring spring = dyn_spring_get(s->network, i);
        digest = stage_digest(digest, spring.end, sizeof spring.end);
        digest = stage_digest(digest, &spring.rest_length, sizeof spring.rest_length);
    }
    FILE *to = s->clamps ? open_memstream(&text, &bytes) : NULL;
    if (to) {
        (void)dyn_clamps_print(s->clamps, to);
        fclose(to);
        digest = stage_digest(digest, text, bytes);
        free(text);
    }
    return digest;
}
