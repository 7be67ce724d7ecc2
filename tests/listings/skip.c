/* skip.c - replaces a test that cannot be built here: it prints why and skips. */
#include <stdio.h>

int main(void)
{
    puts("skipped: " SKIP_REASON);
    return 77;
}
