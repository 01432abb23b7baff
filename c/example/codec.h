/* A decoder of DCON and Modbus RTU on the tables of i7000.h. It is an example, to be read and cut to what you need: it
 * decodes, it does not encode, and it does not allocate. What it returns points into the frame. */
#ifndef CODEC_H
#define CODEC_H

#include "../i7000.h"

/* How the value of a field is kept. */
enum {
    CODEC_NUMBER,
    CODEC_BOOLEAN,
    CODEC_TENTHS, /* a temperature */
    CODEC_TEXT,   /* text, length */
    CODEC_TEXTS,  /* the fields of all channels in text, one behind the other: codec_next_field cuts them */
    CODEC_BITS,   /* `number` bits in text */
    CODEC_WORDS,  /* `number` words in text, high byte first */
    CODEC_NAME,   /* eight hex digits */
};

typedef struct codec_field {
    uint8_t field; /* I7000_FIELD_... */
    uint8_t kind;
    int32_t number;
    const uint8_t *text;
    size_t length;
} codec_field;

typedef struct codec_message {
    uint8_t message; /* I7000_DCON_... or I7000_MODBUS_... */
    uint8_t count;
    codec_field fields[6];
} codec_message;

typedef struct codec_reading {
    uint8_t status; /* I7000_STATUS_... */
    double value;   /* in the unit of the type, if the status is OK */
} codec_reading;

/* All return I7000_FAULT_NONE, or why the bytes are rejected. A command or request whose response is decoded has to be
 * one that is answered, with its fields; of a write of several, field COUNT is the number of values. */
unsigned codec_decode_command(const i7000_profile *profile, const uint8_t *frame, size_t size, codec_message *command);
unsigned codec_decode_response(const i7000_profile *profile, const uint8_t *frame, size_t size,
                               const codec_message *command, codec_message *response);
unsigned codec_decode_request(const i7000_profile *profile, const uint8_t *frame, size_t size, codec_message *request);
unsigned codec_decode_modbus_response(const i7000_profile *profile, const uint8_t *frame, size_t size,
                                      const codec_message *request, codec_message *response);

/* Read the field of one channel. is_old: of an I-7018 up to firmware B1.4. A lenient reader takes numbers that no
 * module of the type sends. */
unsigned codec_read(const uint8_t *text, size_t length, unsigned type, unsigned format, int is_old, int is_lenient,
                    codec_reading *reading);

/* What is cut from a stream of DCON: a frame, or noise with its fault; no bytes if there is nothing yet. */
typedef struct codec_piece {
    unsigned fault;
    const uint8_t *bytes;
    size_t size;
} codec_piece;

/* Zero it, then push every byte; the first `size` bytes of the buffer are what has begun. */
typedef struct codec_splitter {
    uint8_t buffer[I7000_FRAME_SIZE];
    uint8_t cut[I7000_FRAME_SIZE];
    size_t size;
} codec_splitter;

/* Take a byte: `before` is noise that it cuts, `now` what it ends. Both are good until the next call. */
void codec_push(codec_splitter *splitter, uint8_t byte, int has_checksum, codec_piece *before, codec_piece *now);

size_t codec_next_field(const uint8_t *text, size_t left, int is_hex, int is_old);
int codec_is_field(const uint8_t *text, size_t length, unsigned format, int is_old);
int codec_is_old(const i7000_profile *profile);
unsigned codec_checksum(const uint8_t *body, size_t size);
unsigned codec_crc(const uint8_t *bytes, size_t size);

#endif
