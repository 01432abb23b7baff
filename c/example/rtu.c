/* Frames of Modbus RTU: spec/modbus.md. */
#include "common.h"

unsigned codec_crc(const uint8_t *bytes, size_t size)
{
    unsigned crc = 0xFFFFu;
    while (size-- > 0) {
        crc ^= *bytes++;
        for (int bit = 0; bit < 8; bit++)
            crc = (crc & 1u) != 0 ? crc >> 1 ^ 0xA001u : crc >> 1;
    }
    return crc;
}

static const i7000_modbus_request *find_request(unsigned function, int sub_function)
{
    for (size_t at = 0; at < I7000_MODBUS_FUNCTIONS_SIZE; at++)
        if (i7000_modbus_functions[at].function == function)
            return &i7000_modbus_functions[at];
    for (size_t at = 0; at < I7000_MODULE_SETTINGS_SIZE; at++)
        if (function == 0x46 && i7000_module_settings[at].sub_function == sub_function)
            return &i7000_module_settings[at];
    return NULL;
}

static size_t width_of(const i7000_token *token, const i7000_profile *profile, size_t bytes)
{
    if (token->kind == I7000_TOKEN_MASK)
        return (profile->channels + 7u) / 8u;
    return token->kind == I7000_TOKEN_BITS || token->kind == I7000_TOKEN_WORDS ? bytes : token->bytes;
}

/* Add the field of a token, and return its fault if it has one by itself. asked: how many items there have to be. */
static unsigned add_field(const i7000_token *token, const uint8_t *bytes, size_t width, int32_t asked,
                          codec_message *out)
{
    uint32_t number = 0;
    unsigned kind = token->kind == I7000_TOKEN_DIGITS ? CODEC_NAME : CODEC_NUMBER, fault = I7000_FAULT_NONE;
    for (size_t at = 0; at < width && at < 4; at++)
        number = number << 8 | bytes[at];
    switch (token->kind) {
    case I7000_TOKEN_LITERAL:
        return number == token->value ? I7000_FAULT_NONE : I7000_FAULT_RESERVED;
    case I7000_TOKEN_BYTES:
        return I7000_FAULT_NONE;
    case I7000_TOKEN_BITS:
        codec_add(out, token->field, CODEC_BITS, asked, bytes, width);
        return width == ((size_t)asked + 7) / 8 ? I7000_FAULT_NONE : I7000_FAULT_COUNT;
    case I7000_TOKEN_WORDS:
        codec_add(out, token->field, CODEC_WORDS, asked, bytes, width);
        return width == (size_t)asked * 2 ? I7000_FAULT_NONE : I7000_FAULT_COUNT;
    case I7000_TOKEN_COIL:
        kind = CODEC_BOOLEAN;
        fault = number == 0 || number == 0xFF00 ? I7000_FAULT_NONE : I7000_FAULT_VALUE;
        number = fault != I7000_FAULT_NONE ? 2 : number == 0xFF00;
        break;
    case I7000_TOKEN_BOOL:
        kind = CODEC_BOOLEAN; /* fall through */
    case I7000_TOKEN_CODE:
        fault = number > (uint32_t)token->maximum ? I7000_FAULT_VALUE : I7000_FAULT_NONE;
        break;
    case I7000_TOKEN_SIGNED:
        number = number > 0x7FFF ? number | 0xFFFF0000u : number;
        break;
    default:
        break;
    }
    codec_add(out, token->field, kind, (int32_t)number, NULL, 0);
    return fault;
}

/* Whether a response has bits that are reserved: of channels that the module does not have, of settings that there are
 * not, of an offset of a channel, which is one byte. */
static int has_reserved_bits(const codec_message *response, const codec_message *request, const i7000_profile *profile)
{
    int32_t offset = codec_number(response, I7000_FIELD_OFFSET, 0);
    return codec_number(response, I7000_FIELD_MASK, 0) >> profile->channels != 0 ||
           (codec_number(response, I7000_FIELD_SETTINGS, 0) & ~0xA0) != 0 ||
           (codec_number(request, I7000_FIELD_CHANNEL, 0) != 0 && (offset & 0xFF00) != 0);
}

/* Whether a message repeats the fields of the request. */
static int is_echo(const codec_message *message, const codec_message *request)
{
    for (size_t at = 0; at < message->count; at++)
        if (message->fields[at].number != codec_number(request, message->fields[at].field, -1))
            return 0;
    return 1;
}

/* Decode a PDU with the address in front. request: what a response answers, NULL of a request itself. */
static unsigned decode_pdu(const i7000_token *tokens, size_t count, const i7000_modbus_request *row,
                           const i7000_profile *profile, const uint8_t *pdu, size_t size, const codec_message *request,
                           codec_message *out)
{
    unsigned is_found[I7000_FAULT_NAMES_SIZE] = {0}; /* by fault */
    int has_items = 0;
    size_t needed = 1, bytes = 0;
    for (size_t place = 0; place < count; needed += width_of(&tokens[place++], profile, bytes)) {
        if (tokens[place].kind == I7000_TOKEN_BYTES) {
            if (needed >= size)
                return I7000_FAULT_LENGTH;
            bytes = pdu[needed];
            has_items = 1;
        }
    }
    if (needed != size)
        return I7000_FAULT_LENGTH;
    out->count = 0;
    codec_add(out, I7000_FIELD_ADDRESS, CODEC_NUMBER, pdu[0], NULL, 0);
    for (size_t place = 0, at = 1; place < count; place++) {
        size_t width = width_of(&tokens[place], profile, bytes);
        int32_t asked = codec_number(request == NULL ? out : request, I7000_FIELD_COUNT, 0);
        is_found[add_field(&tokens[place], pdu + at, width, asked, out)] = 1;
        at += width;
    }
    if (request == NULL && row->maximum_count > 0) {
        int32_t items = codec_number(out, I7000_FIELD_COUNT, 0), start = codec_number(out, I7000_FIELD_START, 0);
        if (items < row->minimum_count || items > row->maximum_count || start + items > 65536)
            return I7000_FAULT_RANGE;
    }
    if (is_found[I7000_FAULT_COUNT])
        return I7000_FAULT_COUNT;
    if (request != NULL && !has_items && row->sub_function == I7000_NO_SUB_FUNCTION && !is_echo(out, request))
        return I7000_FAULT_ECHO;
    if (is_found[I7000_FAULT_RESERVED] || (request != NULL && has_reserved_bits(out, request, profile)))
        return I7000_FAULT_RESERVED;
    return is_found[I7000_FAULT_VALUE] ? I7000_FAULT_VALUE : I7000_FAULT_NONE;
}

unsigned codec_decode_request(const i7000_profile *profile, const uint8_t *frame, size_t size, codec_message *request)
{
    if (size < 4 || size > I7000_FRAME_SIZE)
        return I7000_FAULT_LENGTH;
    if (codec_crc(frame, size) != 0)
        return I7000_FAULT_CRC;
    if (frame[0] > 247)
        return I7000_FAULT_ADDRESS;
    if (frame[1] == 0x46 && size < 5)
        return I7000_FAULT_LENGTH;
    const i7000_modbus_request *row = find_request(frame[1], frame[2]);
    if (row == NULL)
        return frame[1] == 0x46 ? I7000_FAULT_SUB_FUNCTION : I7000_FAULT_FUNCTION;
    if (frame[0] == 0 && !row->is_broadcast)
        return I7000_FAULT_ADDRESS;
    request->message = (uint8_t)(row->sub_function == I7000_NO_SUB_FUNCTION
                                     ? row - i7000_modbus_functions
                                     : row - i7000_module_settings + I7000_MODBUS_FUNCTIONS_SIZE);
    return decode_pdu(row->tokens, row->token_count, row, profile, frame, size - 2, NULL, request);
}

unsigned codec_decode_modbus_response(const i7000_profile *profile, const uint8_t *frame, size_t size,
                                      const codec_message *request, codec_message *response)
{
    const i7000_modbus_request *row = request->message < I7000_MODBUS_FUNCTIONS_SIZE
                                          ? &i7000_modbus_functions[request->message]
                                          : &i7000_module_settings[request->message - I7000_MODBUS_FUNCTIONS_SIZE];
    if (size < 5 || size > I7000_FRAME_SIZE)
        return I7000_FAULT_LENGTH;
    if (codec_crc(frame, size) != 0)
        return I7000_FAULT_CRC;
    if (frame[0] == 0 || frame[0] != codec_number(request, I7000_FIELD_ADDRESS, 0))
        return I7000_FAULT_ADDRESS;
    if ((frame[1] & 0x7Fu) != row->function)
        return I7000_FAULT_FUNCTION;
    if (frame[1] & 0x80u) {
        if (size != 5)
            return I7000_FAULT_LENGTH;
        *response = (codec_message){.message = I7000_MODBUS_EXCEPTION_RESPONSE};
        codec_add(response, I7000_FIELD_ADDRESS, CODEC_NUMBER, frame[0], NULL, 0);
        codec_add(response, I7000_FIELD_FUNCTION, CODEC_NUMBER, row->function, NULL, 0);
        codec_add(response, I7000_FIELD_EXCEPTION_CODE, CODEC_NUMBER, frame[2], NULL, 0);
        return I7000_FAULT_NONE;
    }
    if (row->sub_function != I7000_NO_SUB_FUNCTION && frame[2] != row->sub_function)
        return I7000_FAULT_SUB_FUNCTION;
    response->message = row->response_message;
    return decode_pdu(row->response_tokens, row->response_token_count, row, profile, frame, size - 2, request,
                      response);
}
