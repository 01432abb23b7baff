/* Frames of DCON: spec/dcon.md. */
#include "common.h"

unsigned codec_checksum(const uint8_t *body, size_t size)
{
    unsigned sum = 0;
    while (size-- > 0)
        sum += *body++;
    return sum & 0xFFu;
}

/* Where a body does not fit a syntax; -1 is its length, the size of the body that it fits. */
typedef struct misfit {
    int at;
    unsigned fault;
} misfit;

static int is_single_ended(const i7000_profile *profile)
{
    return profile->is_single_ended && i7000_models[profile->model].is_single_ended_by_command;
}

static size_t channels_of(const i7000_profile *profile)
{
    const i7000_model *model = &i7000_models[profile->model];
    return is_single_ended(profile) ? model->single_ended_channels : model->channels;
}

static int is_hex_part(const i7000_part *part, const i7000_profile *profile)
{
    return part->width == I7000_WIDTH_FIXED || profile->data_format == I7000_FORMAT_HEX;
}

/* The characters that a part can have. */
static void widths(const i7000_part *part, const i7000_profile *profile, size_t *least, size_t *most)
{
    const i7000_model *model = &i7000_models[profile->model];
    size_t count = part->kind == I7000_KIND_READINGS ? channels_of(profile) : 1;
    *least = *most = part->digits;
    switch (part->width) {
    case I7000_WIDTH_MASK_DIGITS:
        *least = *most = is_single_ended(profile) ? model->mask_digits_single_ended : model->mask_digits;
        break;
    case I7000_WIDTH_CHANNEL_DIGITS:
        *least = *most = is_single_ended(profile) ? part->most_digits : part->digits;
        break;
    case I7000_WIDTH_READING_DIGITS:
        *least = *most = count * (is_hex_part(part, profile) ? part->digits : part->most_digits);
        if (codec_is_old(profile))
            *least = 1, *most = count * (is_hex_part(part, profile) ? 5 : part->most_digits);
        break;
    case I7000_WIDTH_LENGTH:
        *most = part->most_digits;
        break;
    default:
        *least = *most = count * part->digits;
    }
}

static misfit fit_readings(const i7000_part *part, const i7000_profile *profile, const uint8_t *text, size_t size)
{
    int is_old = codec_is_old(profile), is_hex = is_hex_part(part, profile);
    unsigned format = is_hex ? I7000_FORMAT_HEX : profile->data_format;
    size_t count = 0, step;
    misfit found = {(int)size, I7000_FAULT_NONE};
    for (size_t at = 0; at < size; at += step, count++) {
        step = codec_next_field(text + at, size - at, is_hex, is_old);
        if (found.fault == I7000_FAULT_NONE && !codec_is_field(text + at, step, format, is_old))
            found = (misfit){0, is_hex ? I7000_FAULT_CHARACTER : I7000_FAULT_NUMBER};
    }
    if (count != (part->kind == I7000_KIND_READINGS ? channels_of(profile) : 1))
        return (misfit){-1, I7000_FAULT_LENGTH};
    return found;
}

/* Fit one part, and add the field that it is. */
static misfit fit_part(const i7000_part *part, const i7000_profile *profile, const uint8_t *text, size_t size,
                       codec_message *out)
{
    misfit found = {(int)size, I7000_FAULT_NONE};
    int32_t number = 0;
    size_t at = part->kind == I7000_KIND_SIGNED_HEX || part->kind == I7000_KIND_DECIMAL;
    if (part->kind == I7000_KIND_READING || part->kind == I7000_KIND_READINGS)
        found = fit_readings(part, profile, text, size);
    else if (at == 1 && !codec_is_in("+-", text[0]))
        return (misfit){0, I7000_FAULT_NUMBER};
    for (; at < size; at++) {
        int digit = codec_hex_digit(text[at]);
        switch (part->kind) {
        case I7000_KIND_LITERAL:
            if (text[at] != (uint8_t)part->notation[at])
                return (misfit){(int)at, I7000_FAULT_CHARACTER};
            break;
        case I7000_KIND_NAME:
        case I7000_KIND_VERSION:
            if (codec_is_in(I7000_COMMAND_LEADERS I7000_RESPONSE_LEADERS, text[at]))
                return (misfit){(int)at, I7000_FAULT_CHARACTER};
            break;
        case I7000_KIND_BOOL:
        case I7000_KIND_CODE:
            if (digit < 0 || digit > part->maximum)
                return (misfit){0, I7000_FAULT_VALUE};
            number = digit;
            break;
        case I7000_KIND_DECIMAL:
            if (at == 5 ? text[at] != '.' : !codec_is_digit(text[at]))
                return (misfit){0, I7000_FAULT_NUMBER};
            number = at == 5 ? number : number * 10 + digit;
            break;
        case I7000_KIND_HEX:
        case I7000_KIND_SIGNED_HEX:
            if (digit < 0)
                return (misfit){(int)at, I7000_FAULT_CHARACTER};
            number = number * 16 + digit;
            break;
        default: /* readings */
            break;
        }
    }
    if (found.fault == I7000_FAULT_NONE && part->field != I7000_FIELD_NONE) {
        static const uint8_t KINDS[] = {CODEC_NUMBER, CODEC_NUMBER, CODEC_BOOLEAN, CODEC_NUMBER, CODEC_NUMBER,
                                        CODEC_TENTHS, CODEC_TEXT,   CODEC_TEXT,    CODEC_TEXT,   CODEC_TEXTS};
        codec_add(out, part->field, KINDS[part->kind], text[0] == '-' ? -number : number, text, size);
    }
    return found;
}

static misfit fit(const i7000_part *parts, size_t count, const i7000_profile *profile, const uint8_t *body, size_t size,
                  codec_message *out)
{
    size_t least = 0, most = 0, at = 0;
    for (size_t place = 0; place < count; place++) {
        size_t part_least, part_most;
        widths(&parts[place], profile, &part_least, &part_most);
        least += part_least, most += part_most;
    }
    if (size < least || size > most)
        return (misfit){-1, I7000_FAULT_LENGTH};
    out->count = 0;
    for (size_t place = 0; place < count; place++) {
        widths(&parts[place], profile, &least, &most);
        size_t width = most < size - at ? most : size - at;
        misfit found = fit_part(&parts[place], profile, body + at, width, out);
        if (found.fault != I7000_FAULT_NONE)
            return (misfit){found.at < 0 ? -1 : (int)at + found.at, found.fault};
        at += width;
    }
    return (misfit){(int)size, I7000_FAULT_NONE};
}

/* Check a frame, and find the length of its body. */
static unsigned unseal(const uint8_t *frame, size_t size, int has_checksum, const char *leaders, size_t *body_size)
{
    if (size == 0 || size > I7000_FRAME_SIZE)
        return I7000_FAULT_LENGTH;
    if (memchr(frame, '\r', size) != frame + size - 1)
        return I7000_FAULT_TERMINATOR;
    for (size_t at = 0; at < size - 1; at++)
        if (frame[at] < 0x20 || frame[at] > 0x7E)
            return I7000_FAULT_CHARACTER;
    *body_size = size - 1;
    if (!codec_is_in(leaders, frame[0]))
        return I7000_FAULT_LEADING;
    if (!has_checksum)
        return I7000_FAULT_NONE;
    if (size < 4)
        return I7000_FAULT_LENGTH;
    *body_size = size - 3;
    unsigned sum = codec_checksum(frame, *body_size);
    int high = codec_hex_digit(frame[size - 3]), low = codec_hex_digit(frame[size - 2]);
    return high == (int)(sum >> 4) && low == (int)(sum & 15u) ? I7000_FAULT_NONE : I7000_FAULT_CHECKSUM;
}

void codec_push(codec_splitter *splitter, uint8_t byte, int has_checksum, codec_piece *before, codec_piece *now)
{
    static const char LEADERS[] = I7000_COMMAND_LEADERS I7000_RESPONSE_LEADERS;
    uint8_t *buffer = splitter->buffer;
    size_t body;
    *before = *now = (codec_piece){I7000_FAULT_NONE, NULL, 0};
    if (codec_is_in(LEADERS, byte)) {
        if (splitter->size > 0) {
            memcpy(splitter->cut, buffer, splitter->size);
            *before = (codec_piece){I7000_FAULT_TERMINATOR, splitter->cut, splitter->size};
        }
        buffer[0] = byte;
        splitter->size = 1;
        return;
    }
    int is_started = splitter->size > 0;
    buffer[splitter->size++] = byte;
    if (is_started && byte != '\r' && byte >= 0x20 && byte <= 0x7E && splitter->size < I7000_FRAME_SIZE)
        return;
    *now = (codec_piece){I7000_FAULT_LENGTH, buffer, splitter->size};
    if (!is_started)
        now->fault = I7000_FAULT_LEADING;
    else if (byte == '\r')
        now->fault = unseal(buffer, splitter->size, has_checksum, LEADERS, &body) == I7000_FAULT_NONE
                         ? I7000_FAULT_NONE
                         : I7000_FAULT_CHECKSUM;
    else if (byte < 0x20 || byte > 0x7E)
        now->fault = I7000_FAULT_CHARACTER;
    splitter->size = 0;
}

/* Whether a body could be meant for a command. */
static int is_candidate(const char *syntax, const uint8_t *body, size_t size)
{
    if ((uint8_t)syntax[0] != body[0])
        return 0;
    if (!codec_is_in("$~@", body[0]))
        return 1;
    return size > 3 ? (uint8_t)syntax[3] == body[3] : size > 1 && body[1] == '*' && strcmp(syntax, "~**") == 0;
}

unsigned codec_decode_command(const i7000_profile *profile, const uint8_t *frame, size_t size, codec_message *command)
{
    /* The deepest misfit of the commands that the module has, and of those that it does not have. */
    misfit deepest[2] = {{-2, I7000_FAULT_NONE}, {-2, I7000_FAULT_NONE}};
    int is_unsupported = 0;
    size_t body_size;
    unsigned fault = unseal(frame, size, profile->has_checksum, I7000_COMMAND_LEADERS, &body_size);
    if (fault != I7000_FAULT_NONE)
        return fault;
    for (size_t at = 0; at < I7000_DCON_COMMANDS_SIZE; at++) {
        const i7000_dcon_command *it = &i7000_dcon_commands[at];
        if (!is_candidate(it->syntax, frame, body_size))
            continue;
        int has = i7000_has(it->gates, it->gate_count, profile->model, profile->firmware);
        misfit found = fit(it->parts, it->part_count, profile, frame, body_size, command);
        if (found.fault == I7000_FAULT_NONE && has) {
            command->message = (uint8_t)at;
            return I7000_FAULT_NONE;
        }
        if (found.fault == I7000_FAULT_NONE)
            is_unsupported = 1;
        else if (found.at > deepest[has].at)
            deepest[has] = found;
    }
    if (is_unsupported)
        return I7000_FAULT_UNSUPPORTED;
    if (deepest[1].at > -2 || deepest[0].at > -2)
        return deepest[deepest[1].at > -2].fault;
    return body_size > 3 ? I7000_FAULT_COMMAND : I7000_FAULT_LENGTH;
}

/* Whether a text is like one of the patterns: h is a hex digit, d a decimal one, u an upper-case letter, b 0 or 1,
 * t 0 to 2, s a sign, everything else itself. */
static int is_like(const char *const *patterns, const uint8_t *text, size_t length)
{
    for (; *patterns != NULL; patterns++) {
        size_t at = 0;
        for (; at < length && (*patterns)[at] != '\0'; at++) {
            unsigned character = text[at];
            char wanted = (*patterns)[at];
            if (wanted == 'h'   ? codec_hex_digit(character) < 0
                : wanted == 'd' ? !codec_is_digit(character)
                : wanted == 'u' ? character < 'A' || character > 'Z'
                : wanted == 'b' ? !codec_is_in("01", character)
                : wanted == 't' ? !codec_is_in("012", character)
                : wanted == 's' ? !codec_is_in("+-", character)
                                : character != (uint8_t)wanted)
                break;
        }
        if (at == length && (*patterns)[at] == '\0')
            return 1;
    }
    return 0;
}

/* Whether a name could be another response, or a version is invalid. */
static int is_other_text(const codec_message *response)
{
    static const char *const VERSIONS[] = {"ud.d", "ud.dd", NULL};
    static const char *const SERIES[] = {"7017", "7017hh", "7018", "7018hh", "7019", "7019hh", NULL};
    static const char *const OTHERS[] = {"hhhh", "hhhhhh", "hh",     "bhh",  "t",     "shhhh",
                                         "ChRhh", "ChhRhh", "ud.d", "ud.dd", NULL};
    const codec_field *last = &response->fields[response->count - 1];
    if (response->message == I7000_DCON_FIRMWARE_VERSION)
        return !is_like(VERSIONS, last->text, last->length);
    return response->message == I7000_DCON_MODULE_NAME && !is_like(SERIES, last->text, last->length) &&
           is_like(OTHERS, last->text, last->length);
}

unsigned codec_decode_response(const i7000_profile *profile, const uint8_t *frame, size_t size,
                               const codec_message *command, codec_message *response)
{
    static const i7000_part REFUSED[] = {
        {"?", I7000_FIELD_NONE, I7000_KIND_LITERAL, I7000_WIDTH_FIXED, 1, 1, 0, 0},
        {"AA", I7000_FIELD_ADDRESS, I7000_KIND_HEX, I7000_WIDTH_FIXED, 2, 2, 0, 255},
    };
    const i7000_dcon_command *it = &i7000_dcon_commands[command->message];
    const char leaders[] = {'?', it->response_syntax[0], '\0'};
    size_t body_size;
    unsigned fault = unseal(frame, size, profile->has_checksum, leaders, &body_size);
    if (fault != I7000_FAULT_NONE)
        return fault;
    int is_refused = frame[0] == '?';
    response->message = is_refused ? I7000_DCON_REFUSED : it->response;
    fault = fit(is_refused ? REFUSED : it->response_parts, is_refused ? 2 : it->response_part_count, profile, frame,
                body_size, response).fault;
    if (fault != I7000_FAULT_NONE)
        return fault;
    if (is_other_text(response))
        return I7000_FAULT_VALUE;
    int32_t expected = codec_number(command, I7000_FIELD_ADDRESS, 0);
    int is_any = command->message == I7000_DCON_READ_CONFIGURATION && expected == 0;
    if (!is_refused)
        expected = codec_number(command, I7000_FIELD_NEW_ADDRESS, expected);
    if (!is_any && codec_number(response, I7000_FIELD_ADDRESS, expected) != expected)
        return I7000_FAULT_ADDRESS;
    expected = codec_number(command, I7000_FIELD_CHANNEL, 0);
    return codec_number(response, I7000_FIELD_CHANNEL, expected) != expected ? I7000_FAULT_VALUE : I7000_FAULT_NONE;
}
