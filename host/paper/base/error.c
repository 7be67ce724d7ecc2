/* error.c - the last failure, in words. */
#include "base/base.h"

_Thread_local struct error_text paper_last_error;

const char *paper_error(void)
{
    return paper_last_error.text;
}
