/* The test vectors of spec/vectors/ for unit tests, on the host or on the target.
 *
 * Generated from spec/ by `python -m c.generate`. Do not edit. License: MIT.
 *
 * Each section is compiled only if you ask for it: define I7000_VECTORS_DCON_2_10 for one section, I7000_VECTORS_DCON,
 * _MODBUS, _READINGS, _REGISTERS or _FRAMES for all of a kind, I7000_VECTORS_ALL for everything. Then include this file
 * in the test. The arrays are static. i7000_exchange_sections and i7000_reading_sections list what is compiled.
 *
 * spec/runner.md says what your codec has to do with each vector. The id finds it in spec/vectors/, where its comment
 * is; the erratum is explained in spec/errata.json.
 */
#ifndef I7000_VECTORS_H
#define I7000_VECTORS_H

#include "i7000.h"

#define I7000_WIRE(bytes) (const uint8_t *)(bytes), sizeof(bytes) - 1
#define I7000_NO_WIRE NULL, 0

enum {
    I7000_OUTCOME_RESPONSE = 0,
    I7000_OUTCOME_REFUSED = 1,   /* ?AA */
    I7000_OUTCOME_EXCEPTION = 1, /* the same in Modbus */
    I7000_OUTCOME_SILENCE = 2,   /* a broadcast */
    I7000_OUTCOME_REJECT = 3,    /* a decoder refuses the response, or the command if there is no response */
};

enum {
    I7000_SOURCE_MANUAL = 0, /* printed in the manual */
    I7000_SOURCE_DERIVED = 1,
    I7000_SOURCE_ASSUMED = 2, /* rests on an assumption */
};

/* Flags, as bits. */
enum {
    I7000_FLAG_HOST_REFUSES = 1,     /* an encoder must refuse the command */
    I7000_FLAG_HOST_MAY_REFUSE = 2,  /* an encoder that knows the models and maps may */
    I7000_FLAG_NEEDS_STATE = 4,      /* a module answers so only in a certain state */
    I7000_FLAG_DECODE_ONLY = 8,      /* an encoder writes other bytes */
    I7000_FLAG_LENIENT = 16,         /* a reading only for a lenient reader; another rejects it with the fault NUMBER */
    I7000_FLAG_MISPRINT = 32,        /* the example has a slip in the manual */
};

/* Whose frames a stream of Modbus has. */
enum {
    I7000_SIDE_REQUESTS = 0,
    I7000_SIDE_RESPONSES = 1,
    I7000_SIDE_BOTH = 2,
};

/* --- exchanges: vectors/dcon, vectors/modbus ---------------------------------------------------------------------- */

/* A field of a message; what its kind does not have is 0 or NULL. */
typedef struct i7000_vector_field {
    uint8_t field;            /* I7000_FIELD_... */
    int32_t number;           /* a number or truth value; a temperature in tenths; the name of a module in Modbus */
    const char *text;         /* a name, a version, the field of one channel */
    const char *const *texts; /* the fields of `count` channels */
    const uint16_t *words;    /* `count` registers, or bits */
    size_t count;
} i7000_vector_field;

typedef struct i7000_vector_message {
    uint8_t message; /* I7000_DCON_..., I7000_MODBUS_... */
    const i7000_vector_field *fields;
    size_t field_count;
} i7000_vector_message;

typedef struct i7000_exchange {
    const char *id;
    const char *section;
    const char *erratum; /* or NULL */
    const i7000_profile *profile;
    uint8_t outcome; /* I7000_OUTCOME_... */
    uint8_t fault;   /* I7000_FAULT_..., of what is rejected: the response if there is one, else the command */
    uint8_t source;  /* I7000_SOURCE_... */
    uint8_t flags;   /* I7000_FLAG_... */
    const uint8_t *command; /* or request: the whole frame */
    size_t command_size;
    const i7000_vector_message *command_message; /* NULL: it does not decode */
    const uint8_t *response; /* NULL: none */
    size_t response_size;
    const i7000_vector_message *response_message;
} i7000_exchange;

typedef struct i7000_exchange_section {
    const char *file; /* in spec/vectors/ */
    uint8_t is_modbus;
    const i7000_exchange *vectors;
    size_t count;
} i7000_exchange_section;

/* --- readings: vectors/readings ----------------------------------------------------------------------------------- */

typedef struct i7000_reading_vector {
    const char *id;
    const char *section;
    const char *erratum;
    uint8_t source;
    uint8_t flags;
    uint8_t type;
    uint8_t format;
    uint8_t direction; /* I7000_READ: text to reading; I7000_WRITE: reading to text */
    uint8_t status;
    uint8_t fault; /* of a text that is rejected */
    const char *text;
    double value; /* in the unit of the type; 0 if the status is not OK */
} i7000_reading_vector;

typedef struct i7000_reading_section {
    const char *file;
    const i7000_reading_vector *vectors;
    size_t count;
} i7000_reading_section;

/* A line of an I-7018 up to firmware B1.4. */
typedef struct i7000_line_vector {
    const char *id;
    const char *section;
    const char *erratum;
    uint8_t source;
    const i7000_profile *profile;
    const char *line;
    const char *const *texts;
    const uint8_t *statuses;
    size_t count;
} i7000_line_vector;

/* The fields of a response, read with the types of their channels. */
typedef struct i7000_channels_vector {
    const char *id;
    const char *section;
    const char *erratum;
    uint8_t source;
    const i7000_profile *profile;
    const i7000_vector_message *command;
    const i7000_vector_message *response;
    const double *values;
    const uint8_t *units;
    const uint8_t *statuses;
    size_t count;
} i7000_channels_vector;

/* --- registers: vectors/registers --------------------------------------------------------------------------------- */

typedef struct i7000_register_vector {
    const char *id;
    const char *section;
    const char *erratum;
    uint8_t source;
    const i7000_profile *profile;
    const char *name; /* of the row of the map */
    uint8_t first;    /* the first item belongs to this value of the row */
    uint8_t is_big_endian;
    uint8_t direction;
    uint8_t fault;
    const uint32_t *items;
    size_t item_count;
    const double *values; /* NULL: there is a fault */
    const uint8_t *statuses; /* NULL: these are not readings */
    size_t count;
} i7000_register_vector;

/* --- frames: vectors/frames --------------------------------------------------------------------------------------- */

/* A body and its check characters: two hex digits of DCON, two bytes of a CRC. */
typedef struct i7000_check_vector {
    const char *id;
    const char *section;
    const uint8_t *body;
    size_t size;
    const uint8_t *check;
    size_t check_size;
} i7000_check_vector;

typedef struct i7000_event {
    uint8_t fault; /* of noise; NONE of a frame */
    const uint8_t *bytes;
    size_t size;
} i7000_event;

/* A stream cut into frames and noise. Merge adjacent noise of your splitter, with its first fault. */
typedef struct i7000_split_vector {
    const char *id;
    const char *section;
    const char *erratum;
    uint8_t source;
    uint8_t has_checksum; /* of DCON */
    uint8_t side;         /* I7000_SIDE_..., of Modbus */
    const i7000_profile *profile; /* NULL: unknown */
    const uint8_t *stream;
    size_t size;
    const i7000_event *events;
    size_t event_count;
    const uint8_t *rest;
    size_t rest_size;
    const i7000_event *flushed; /* what becomes of the rest after a silence, in Modbus */
    size_t flushed_count;
} i7000_split_vector;

/* --- sections ----------------------------------------------------------------------------------------------------- */

/* @sections */

/* The sections that are compiled; the last row is empty. */
/* @lists */

#endif /* I7000_VECTORS_H */
