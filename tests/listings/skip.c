/* skip.c - stands for a test that cannot be built here; says why. */
#include <stdio.h>

int main(void)
{
    puts("skipped: " SKIP_REASON);
    return 77;
}
