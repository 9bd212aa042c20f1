#include "fail.h"

#include <stdarg.h>
#include <stdio.h>

bool fail_with(char error[ERROR_LENGTH], const char *format, ...) {
    if (error[0] == '\0') {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(error, ERROR_LENGTH, format, arguments);
        va_end(arguments);
    }
    return false;
}
