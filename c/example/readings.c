/* Fields of channels: spec/readings.md. */
#include "common.h"

int codec_is_old(const i7000_profile *profile)
{
    return profile->model >= I7000_MODEL_I_7018 && profile->model <= I7000_MODEL_I_7018Z &&
           profile->firmware <= I7000_FIRMWARE('B', 1, 4);
}

/* The length of the first field of a line. Only old firmware has fields of several lengths. */
size_t codec_next_field(const uint8_t *text, size_t left, int is_hex, int is_old)
{
    size_t width = is_hex ? 4 : 7, at = 1;
    if (is_hex && is_old && codec_is_in("+-", text[0]))
        width = 5;
    if (is_hex || !is_old)
        return left < width ? left : width;
    if (text[0] == ' ')
        while (at < left && at < width && text[at] == ' ')
            at++;
    else
        while (at < left && !codec_is_in("+- ", text[at]))
            at++;
    return at;
}

/* Engineering and percent share their special texts (E48). */
static const i7000_sentinel *find_sentinel(const uint8_t *text, size_t length, uint32_t types, unsigned format,
                                           int is_old)
{
    for (size_t at = 0; at < I7000_SENTINELS_SIZE; at++) {
        const i7000_sentinel *it = &i7000_sentinels[at];
        int is_format = it->format == format || (it->format < I7000_FORMAT_HEX && format < I7000_FORMAT_HEX);
        if (it->text != NULL && is_format && (it->types & types) != 0 && (is_old || !it->is_legacy) &&
            strlen(it->text) == length && memcmp(it->text, text, length) == 0)
            return it;
    }
    return NULL;
}

/* Whether a text is a number of a format. counts gets its digits, decimals how many are behind the point. */
static int is_number(const uint8_t *text, size_t length, unsigned format, int32_t *counts, unsigned *decimals)
{
    int is_hex = format == I7000_FORMAT_HEX, base = is_hex ? 16 : 10;
    unsigned points = 0;
    *counts = 0, *decimals = 0;
    if (length != (is_hex ? 4u : 7u) || (!is_hex && !codec_is_in("+-", text[0])))
        return 0;
    for (size_t at = is_hex ? 0 : 1; at < length; at++) {
        int digit = codec_hex_digit(text[at]);
        if (!is_hex && text[at] == '.')
            points++, *decimals = (unsigned)(length - 1 - at);
        else if (digit < 0 || digit >= base)
            return 0;
        else
            *counts = *counts * base + digit;
    }
    if (text[0] == '-')
        *counts = -*counts;
    if (format == I7000_FORMAT_ENGINEERING)
        return points == 1 && *decimals >= 1 && *decimals <= 4;
    return is_hex || (points == 1 && *decimals == 2);
}

int codec_is_field(const uint8_t *text, size_t length, unsigned format, int is_old)
{
    int32_t counts;
    unsigned decimals;
    return is_number(text, length, format, &counts, &decimals) ||
           find_sentinel(text, length, UINT32_MAX, format, is_old) != NULL;
}

unsigned codec_read(const uint8_t *text, size_t length, unsigned type, unsigned format, int is_old, int is_lenient,
                    codec_reading *reading)
{
    static const double SCALES[] = {1, 10, 100, 1000, 10000};
    const i7000_type *it = &i7000_types[type];
    const i7000_sentinel *sentinel = find_sentinel(text, length, (uint32_t)1 << type, format, is_old);
    int32_t counts;
    unsigned decimals;
    *reading = (codec_reading){sentinel == NULL ? I7000_STATUS_OK : sentinel->status, 0.0};
    if (sentinel != NULL)
        return I7000_FAULT_NONE;
    if (!is_number(text, length, format, &counts, &decimals))
        return format == I7000_FORMAT_HEX ? I7000_FAULT_CHARACTER : I7000_FAULT_NUMBER;
    /* The value is base + counts * span / parts, in the last digit of an engineering field. */
    int64_t base = 0, span = 1, parts = 1;
    if (format != I7000_FORMAT_ENGINEERING) {
        base = it->is_hex_signed ? 0 : it->minimum;
        span = it->is_hex_signed ? it->max : it->maximum - it->minimum;
        if (format == I7000_FORMAT_HEX && it->is_hex_signed && counts > 0x7FFF)
            counts -= 0x10000;
        parts = format == I7000_FORMAT_PERCENT ? 10000 : !it->is_hex_signed ? 65535 : counts < 0 ? 32768 : 32767;
        decimals = it->decimals;
    }
    int64_t tenfold = 10 * (base * parts + counts * span);
    if (!is_lenient && (decimals != it->decimals || tenfold < (10 * (int64_t)it->minimum - it->max) * parts ||
                        tenfold > (10 * (int64_t)it->maximum + it->max) * parts))
        return I7000_FAULT_NUMBER;
    reading->value = (double)(base * parts + counts * span) / (double)parts / SCALES[decimals];
    return I7000_FAULT_NONE;
}
