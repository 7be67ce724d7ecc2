/* test_second_opinion.c - compares the scenes on the machine with those on the plain C/Paris,
 * bit for bit. */
#include "scenes.h"

#include <string.h>

int main(int argc, char **argv)
{
    char ours[128], theirs[128];
    int lines = 0, wrong = 0;
    FILE *mine = tmpfile(), *plain = argc == 2 ? popen(argv[1], "r") : NULL;
    if (!mine || !plain)
        return 1;
    scene_play(mine);
    rewind(mine);
    while (fgets(ours, sizeof ours, mine)) {
        lines++;
        if (!fgets(theirs, sizeof theirs, plain) || strcmp(ours, theirs) != 0) {
            fprintf(stderr, "%sis not, plain, %s", ours, theirs);
            wrong++;
        }
    }
    if (pclose(plain) != 0 || lines < 2 * 10 * SCENE_TURNS)
        return 1;
    fclose(mine);
    return wrong != 0;
}
