/* scenes_plain.c - the scenes on the plain C/Paris, for test_second_opinion.c. */
#include "scenes.h"

int main(void)
{
    scene_play(stdout);
    return 0;
}
