/* What the files of the example share. */
#ifndef COMMON_H
#define COMMON_H

#include <string.h>

#include "codec.h"

static inline void codec_add(codec_message *message, unsigned field, unsigned kind, int32_t number, const uint8_t *text,
                             size_t length)
{
    message->fields[message->count++] = (codec_field){(uint8_t)field, (uint8_t)kind, number, text, length};
}

static inline int32_t codec_number(const codec_message *message, unsigned field, int32_t otherwise)
{
    for (size_t at = 0; at < message->count; at++)
        if (message->fields[at].field == field)
            return message->fields[at].number;
    return otherwise;
}

static inline int codec_is_in(const char *set, unsigned character)
{
    return character != 0 && strchr(set, (int)character) != NULL;
}

static inline int codec_is_digit(unsigned character) { return character >= '0' && character <= '9'; }

static inline int codec_hex_digit(unsigned character)
{
    if (codec_is_digit(character))
        return (int)character - '0';
    return character >= 'A' && character <= 'F' ? (int)character - 'A' + 10 : -1;
}

#endif
