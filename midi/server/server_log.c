/* server_log.c - see server_log.h. */
#include "server_log.h"

#include <midi_time.h>

#include <stdarg.h>
#include <stdio.h>

void log_begin(struct server_log *log, void (*line)(void *context, const char *line),
               void *context)
{
    *log = (struct server_log){.line = line, .context = context};
}

__attribute__((format(printf, 3, 0))) static void
line_tell(struct server_log *log, uint64_t now_ns, const char *format, va_list arguments)
{
    const uint64_t every_ns = LOG_EVERY_S * UINT64_C(1000000000);
    char text[LOG_LINE_BYTES];
    if (!log->line)
        return;
    if (log->paid_ns < now_ns)
        log->paid_ns = now_ns;
    if (log->paid_ns - now_ns > (LOG_AT_ONCE - 1) * every_ns) {
        log->left_out++;
        return;
    }
    log->paid_ns += every_ns;
    if (log->left_out) {
        snprintf(text, sizeof text, "(%u lines were left out: too many in a row)",
                 log->left_out);
        log->line(log->context, text);
        log->left_out = 0;
    }
    vsnprintf(text, sizeof text, format, arguments);
    log->line(log->context, text);
}

void log_tell(struct server_log *log, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    line_tell(log, midi_now_ns(), format, arguments);
    va_end(arguments);
}

void log_tell_at(struct server_log *log, uint64_t now_ns, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    line_tell(log, now_ns, format, arguments);
    va_end(arguments);
}
