/* A Modbus RTU slave on libmodbus with a map like that of an M-7017, at address 1 of a pseudo-terminal.
 *
 * It prints the name of the terminal, and answers until it is killed.
 */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <modbus/modbus.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The map is one run of items of each kind: libmodbus has no gaps. */
enum { COILS = 128, LAST_COIL = 272, STATUS = 128, CHANNELS = 8, SETTINGS = 480, LAST_SETTING = 491 };
enum { ADDRESS = 1, PAUSE = 20000 /* microseconds */ };

static modbus_mapping_t *map_of_m7017(void)
{
    static const uint16_t settings[] = {
        0x0405, 0x000B, /* 40481 firmware */
        0x1700, 0x0070, /* 40483 name */
        ADDRESS,        /* 40485 address */
        0x0006,         /* 40486 9600 baud, N81 */
        0x0008,         /* 40487 type: -10 V to +10 V */
        0, 0,           /* 40488 response delay, 40489 host watchdog timeout */
        0x00FF,         /* 40490 all channels enabled */
        0, 0,           /* 40491 has no meaning, 40492 host watchdog timeout count */
    };
    modbus_mapping_t *map = modbus_mapping_new_start_address(
        COILS, LAST_COIL - COILS + 1, STATUS, CHANNELS, 0, LAST_SETTING + 1, 0, CHANNELS);
    if (map == NULL)
        return NULL;
    map->tab_bits[256 - COILS] = 1; /* 00257 Modbus RTU */
    map->tab_bits[272 - COILS] = 1; /* 00273 reset since the last read; it stays so */
    memcpy(map->tab_registers + SETTINGS, settings, sizeof settings);
    return map;
}

static int fail(const char *what)
{
    fprintf(stderr, "%s: %s\n", what, modbus_strerror(errno));
    return EXIT_FAILURE;
}

int main(void)
{
    uint8_t request[MODBUS_RTU_MAX_ADU_LENGTH];
    modbus_mapping_t *map = map_of_m7017();
    modbus_t *slave = modbus_new_rtu("/dev/ptmx", 9600, 'N', 8, 1);

    if (map == NULL || slave == NULL || modbus_set_slave(slave, ADDRESS) == -1)
        return fail("slave");
    /* By default libmodbus waits half a second for the rest of a request, and takes the next request for it; it also
     * sleeps for half a second before it refuses a request. */
    modbus_set_byte_timeout(slave, 0, PAUSE);
    modbus_set_response_timeout(slave, 0, PAUSE);
    modbus_set_error_recovery(slave, MODBUS_ERROR_RECOVERY_PROTOCOL);
    if (modbus_connect(slave) == -1)
        return fail("/dev/ptmx");
    int terminal = modbus_get_socket(slave);
    if (grantpt(terminal) == -1 || unlockpt(terminal) == -1)
        return fail("pseudo-terminal");
    /* A terminal that is open here too does not hang up when the host closes it. */
    if (open(ptsname(terminal), O_RDWR | O_NOCTTY) == -1)
        return fail(ptsname(terminal));
    printf("%s\n", ptsname(terminal));
    fflush(stdout);

    for (;;) {
        int length = modbus_receive(slave, request);
        if (length > 0)
            modbus_reply(slave, request, length, map);
    }
}
