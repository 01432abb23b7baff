-- The I-7000 and M-7000 analog input modules in Wireshark: DCON, and what the modules mean by Modbus.
--
-- Generated from spec/ by: python -m wireshark.generate
-- Install: copy this file into the folder that Help, About Wireshark, Folders names Personal Lua Plugins.
-- wireshark/README.md explains preferences and fields. Tested with Wireshark 4.0. MIT licence.

local MODELS = {
    {
        name = "I-7017",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = false,
        default_type = 8,
        types = {
            [7] = "B2.2",
            [8] = false,
            [9] = false,
            [10] = false,
            [11] = false,
            [12] = false,
            [13] = false,
            [26] = "B2.2",
        },
    },
    {
        name = "I-7017F",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = true,
        default_type = 8,
        types = {
            [7] = "B2.2",
            [8] = false,
            [9] = false,
            [10] = false,
            [11] = false,
            [12] = false,
            [13] = false,
            [26] = "B2.2",
        },
    },
    {
        name = "I-7017C",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = false,
        default_type = 13,
        types = { [7] = "B2.2", [13] = false, [26] = "B2.2" },
    },
    {
        name = "I-7017FC",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = true,
        default_type = 13,
        types = { [7] = "B2.2", [13] = false, [26] = "B2.2" },
    },
    {
        name = "I-7017R",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        individually_configurable = "B3.9",
        mixed_types = "B3.9",
        mask_digits = 2,
        fast_mode = true,
        default_type = 8,
        types = {
            [7] = "B2.2",
            [8] = false,
            [9] = false,
            [10] = false,
            [11] = false,
            [12] = false,
            [13] = false,
            [26] = "B2.2",
        },
    },
    {
        name = "I-7017RC",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = true,
        default_type = 13,
        types = { [7] = "B2.2", [13] = false, [26] = "B2.2" },
    },
    {
        name = "I-7017R-A5",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = true,
        default_type = 27,
        types = { [27] = false, [28] = false },
    },
    {
        name = "I-7017Z",
        series = "7017",
        channels = 10,
        single_ended_channels = 20,
        single_ended_by_command = true,
        individually_configurable = "always",
        mixed_types = "ignored",
        mask_digits = 4,
        mask_digits_single_ended = 6,
        fast_mode = true,
        default_type = 8,
        types = {
            [7] = false,
            [8] = false,
            [9] = false,
            [10] = false,
            [11] = false,
            [12] = false,
            [13] = false,
            [26] = false,
        },
    },
    {
        name = "M-7017",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = false,
        default_type = 8,
        types = {
            [7] = "B2.2",
            [8] = false,
            [9] = false,
            [10] = false,
            [11] = false,
            [12] = false,
            [13] = false,
            [26] = "B2.2",
        },
    },
    {
        name = "M-7017C",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = false,
        default_type = 13,
        types = { [7] = "B2.2", [13] = false, [26] = "B2.2" },
    },
    {
        name = "M-7017R",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        individually_configurable = "B3.9",
        mixed_types = "B3.9",
        mask_digits = 2,
        fast_mode = true,
        default_type = 8,
        types = {
            [7] = "B2.2",
            [8] = false,
            [9] = false,
            [10] = false,
            [11] = false,
            [12] = false,
            [13] = false,
            [26] = "B2.2",
        },
    },
    {
        name = "M-7017RC",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = true,
        default_type = 13,
        types = { [7] = "B2.2", [13] = false, [26] = "B2.2" },
    },
    {
        name = "M-7017R-A5",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = true,
        default_type = 27,
        types = { [27] = false, [28] = false },
    },
    {
        name = "M-7017Z",
        series = "7017",
        channels = 10,
        single_ended_channels = 20,
        single_ended_by_command = true,
        individually_configurable = "always",
        mixed_types = "ignored",
        mask_digits = 4,
        mask_digits_single_ended = 6,
        fast_mode = true,
        default_type = 8,
        types = {
            [7] = false,
            [8] = false,
            [9] = false,
            [10] = false,
            [11] = false,
            [12] = false,
            [13] = false,
            [26] = false,
        },
    },
    {
        name = "M-7017RMS",
        series = "7017",
        channels = 8,
        single_ended_by_command = false,
        individually_configurable = "always",
        mixed_types = "always",
        mask_digits = 2,
        fast_mode = false,
        default_type = 8,
        types = { [8] = false, [9] = false, [10] = false, [11] = false, [12] = false },
    },
    {
        name = "M-7017mC-16",
        series = "7017",
        channels = 16,
        single_ended_channels = 16,
        single_ended_by_command = false,
        individually_configurable = "always",
        mixed_types = "ignored",
        mask_digits = 4,
        fast_mode = true,
        default_type = 13,
        types = { [7] = "B2.2", [13] = false, [26] = "B2.2" },
    },
    {
        name = "I-7018",
        series = "7018",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = false,
        default_type = 5,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
        },
    },
    {
        name = "I-7018P",
        series = "7018",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = false,
        default_type = 5,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
            [23] = false,
            [24] = false,
        },
    },
    {
        name = "I-7018BL",
        series = "7018",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = false,
        types = {
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
        },
    },
    {
        name = "I-7018R",
        series = "7018",
        channels = 8,
        single_ended_by_command = false,
        individually_configurable = "B4.2",
        mixed_types = "B4.2",
        mask_digits = 2,
        fast_mode = false,
        default_type = 5,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
            [23] = false,
            [24] = false,
            [25] = false,
        },
    },
    {
        name = "I-7018Z",
        series = "7018",
        channels = 10,
        single_ended_by_command = false,
        individually_configurable = "always",
        mixed_types = "ignored",
        mask_digits = 4,
        fast_mode = false,
        default_type = 5,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [7] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
            [23] = false,
            [24] = false,
            [25] = false,
            [26] = false,
        },
    },
    {
        name = "M-7018",
        series = "7018",
        channels = 8,
        single_ended_by_command = false,
        mask_digits = 2,
        fast_mode = false,
        default_type = 5,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
        },
    },
    {
        name = "M-7018R",
        series = "7018",
        channels = 8,
        single_ended_by_command = false,
        individually_configurable = "B4.5",
        mixed_types = "B4.5",
        mask_digits = 2,
        fast_mode = false,
        default_type = 5,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
            [23] = false,
            [24] = false,
            [25] = false,
        },
    },
    {
        name = "M-7018Z",
        series = "7018",
        channels = 10,
        single_ended_by_command = false,
        individually_configurable = "always",
        mixed_types = "ignored",
        mask_digits = 4,
        fast_mode = false,
        default_type = 5,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [7] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
            [23] = false,
            [24] = false,
            [25] = false,
            [26] = false,
        },
    },
    {
        name = "M-7018-16",
        series = "7018",
        channels = 16,
        single_ended_by_command = false,
        mask_digits = 4,
        fast_mode = false,
        default_type = 5,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
        },
    },
    {
        name = "I-7019R",
        series = "7019",
        channels = 8,
        single_ended_by_command = false,
        individually_configurable = "always",
        mixed_types = "ignored",
        mask_digits = 2,
        fast_mode = false,
        default_type = 8,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [7] = "B2.7",
            [8] = false,
            [9] = false,
            [10] = false,
            [11] = false,
            [12] = false,
            [13] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
            [23] = false,
            [24] = false,
            [25] = false,
            [26] = "B2.7",
        },
    },
    {
        name = "M-7019R",
        series = "7019",
        channels = 8,
        single_ended_by_command = false,
        individually_configurable = "always",
        mixed_types = "ignored",
        mask_digits = 2,
        fast_mode = false,
        default_type = 8,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [7] = "B2.7",
            [8] = false,
            [9] = false,
            [10] = false,
            [11] = false,
            [12] = false,
            [13] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
            [23] = false,
            [24] = false,
            [25] = false,
            [26] = "B2.7",
        },
    },
    {
        name = "M-7019Z",
        series = "7019",
        channels = 10,
        single_ended_by_command = false,
        individually_configurable = "always",
        mixed_types = "ignored",
        mask_digits = 4,
        fast_mode = false,
        default_type = 8,
        types = {
            [0] = false,
            [1] = false,
            [2] = false,
            [3] = false,
            [4] = false,
            [5] = false,
            [6] = false,
            [7] = false,
            [8] = false,
            [9] = false,
            [10] = false,
            [11] = false,
            [12] = false,
            [13] = false,
            [14] = false,
            [15] = false,
            [16] = false,
            [17] = false,
            [18] = false,
            [19] = false,
            [20] = false,
            [21] = false,
            [22] = false,
            [23] = false,
            [24] = false,
            [25] = false,
            [26] = false,
        },
    },
}

local SERIES = { ["7017"] = true, ["7018"] = true, ["7019"] = true }

local TYPES = {
    [0] = {
        code = 0,
        key = "MV_15",
        name = "+/-15 mV",
        unit = "mV",
        minimum = -15,
        maximum = 15,
        max = 15,
        engineering_decimals = 3,
        hex_signed = true,
        modbus_counts_per_unit = 1000,
    },
    [1] = {
        code = 1,
        key = "MV_50",
        name = "+/-50 mV",
        unit = "mV",
        minimum = -50,
        maximum = 50,
        max = 50,
        engineering_decimals = 3,
        hex_signed = true,
        modbus_counts_per_unit = 100,
    },
    [2] = {
        code = 2,
        key = "MV_100",
        name = "+/-100 mV",
        unit = "mV",
        minimum = -100,
        maximum = 100,
        max = 100,
        engineering_decimals = 2,
        hex_signed = true,
        modbus_counts_per_unit = 100,
    },
    [3] = {
        code = 3,
        key = "MV_500_03",
        name = "+/-500 mV",
        unit = "mV",
        minimum = -500,
        maximum = 500,
        max = 500,
        engineering_decimals = 2,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [4] = {
        code = 4,
        key = "V_1_04",
        name = "+/-1 V",
        unit = "V",
        minimum = -1,
        maximum = 1,
        max = 1,
        engineering_decimals = 4,
        hex_signed = true,
        modbus_counts_per_unit = 10000,
    },
    [5] = {
        code = 5,
        key = "V_2_5",
        name = "+/-2.5 V",
        unit = "V",
        minimum = -2.5,
        maximum = 2.5,
        max = 2.5,
        engineering_decimals = 4,
        hex_signed = true,
        modbus_counts_per_unit = 10000,
    },
    [6] = {
        code = 6,
        key = "MA_20_06",
        name = "+/-20 mA",
        unit = "mA",
        minimum = -20,
        maximum = 20,
        max = 20,
        engineering_decimals = 3,
        hex_signed = true,
        modbus_counts_per_unit = 1000,
    },
    [7] = {
        code = 7,
        key = "MA_4_20",
        name = "+4 to +20 mA",
        unit = "mA",
        minimum = 4,
        maximum = 20,
        max = 20,
        engineering_decimals = 3,
        hex_signed = false,
        modbus_counts_per_unit = 1000,
    },
    [8] = {
        code = 8,
        key = "V_10",
        name = "+/-10 V",
        unit = "V",
        minimum = -10,
        maximum = 10,
        max = 10,
        engineering_decimals = 3,
        hex_signed = true,
        modbus_counts_per_unit = 1000,
    },
    [9] = {
        code = 9,
        key = "V_5",
        name = "+/-5 V",
        unit = "V",
        minimum = -5,
        maximum = 5,
        max = 5,
        engineering_decimals = 4,
        hex_signed = true,
        modbus_counts_per_unit = 1000,
    },
    [10] = {
        code = 10,
        key = "V_1_0A",
        name = "+/-1 V",
        unit = "V",
        minimum = -1,
        maximum = 1,
        max = 1,
        engineering_decimals = 4,
        hex_signed = true,
        modbus_counts_per_unit = 10000,
    },
    [11] = {
        code = 11,
        key = "MV_500_0B",
        name = "+/-500 mV",
        unit = "mV",
        minimum = -500,
        maximum = 500,
        max = 500,
        engineering_decimals = 2,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [12] = {
        code = 12,
        key = "MV_150",
        name = "+/-150 mV",
        unit = "mV",
        minimum = -150,
        maximum = 150,
        max = 150,
        engineering_decimals = 2,
        hex_signed = true,
        modbus_counts_per_unit = 100,
    },
    [13] = {
        code = 13,
        key = "MA_20_0D",
        name = "+/-20 mA",
        unit = "mA",
        minimum = -20,
        maximum = 20,
        max = 20,
        engineering_decimals = 3,
        hex_signed = true,
        modbus_counts_per_unit = 1000,
    },
    [14] = {
        code = 14,
        key = "J",
        name = "Type J thermocouple",
        unit = "degC",
        minimum = -210,
        maximum = 760,
        max = 760,
        engineering_decimals = 2,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [15] = {
        code = 15,
        key = "K",
        name = "Type K thermocouple",
        unit = "degC",
        minimum = -270,
        maximum = 1372,
        max = 1372,
        engineering_decimals = 1,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [16] = {
        code = 16,
        key = "T",
        name = "Type T thermocouple",
        unit = "degC",
        minimum = -270,
        maximum = 400,
        max = 400,
        engineering_decimals = 2,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [17] = {
        code = 17,
        key = "E",
        name = "Type E thermocouple",
        unit = "degC",
        minimum = -270,
        maximum = 1000,
        max = 1000,
        engineering_decimals = 1,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [18] = {
        code = 18,
        key = "R",
        name = "Type R thermocouple",
        unit = "degC",
        minimum = 0,
        maximum = 1768,
        max = 1768,
        engineering_decimals = 1,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [19] = {
        code = 19,
        key = "S",
        name = "Type S thermocouple",
        unit = "degC",
        minimum = 0,
        maximum = 1768,
        max = 1768,
        engineering_decimals = 1,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [20] = {
        code = 20,
        key = "B",
        name = "Type B thermocouple",
        unit = "degC",
        minimum = 0,
        maximum = 1820,
        max = 1820,
        engineering_decimals = 1,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [21] = {
        code = 21,
        key = "N",
        name = "Type N thermocouple",
        unit = "degC",
        minimum = -270,
        maximum = 1300,
        max = 1300,
        engineering_decimals = 1,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [22] = {
        code = 22,
        key = "C",
        name = "Type C thermocouple",
        unit = "degC",
        minimum = 0,
        maximum = 2320,
        max = 2320,
        engineering_decimals = 1,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [23] = {
        code = 23,
        key = "L",
        name = "Type L thermocouple",
        unit = "degC",
        minimum = -200,
        maximum = 800,
        max = 800,
        engineering_decimals = 2,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [24] = {
        code = 24,
        key = "M",
        name = "Type M thermocouple",
        unit = "degC",
        minimum = -200,
        maximum = 100,
        max = 200,
        engineering_decimals = 2,
        hex_signed = true,
        modbus_counts_per_unit = 100,
    },
    [25] = {
        code = 25,
        key = "L_DIN43710",
        name = "Type L DIN43710 thermocouple",
        unit = "degC",
        minimum = -200,
        maximum = 900,
        max = 900,
        engineering_decimals = 2,
        hex_signed = true,
        modbus_counts_per_unit = 10,
    },
    [26] = {
        code = 26,
        key = "MA_0_20",
        name = "0 to +20 mA",
        unit = "mA",
        minimum = 0,
        maximum = 20,
        max = 20,
        engineering_decimals = 3,
        hex_signed = false,
        modbus_counts_per_unit = 1000,
    },
    [27] = {
        code = 27,
        key = "V_150",
        name = "+/-150 V",
        unit = "V",
        minimum = -150,
        maximum = 150,
        max = 150,
        engineering_decimals = 2,
        hex_signed = true,
        modbus_counts_per_unit = 100,
    },
    [28] = {
        code = 28,
        key = "V_50",
        name = "+/-50 V",
        unit = "V",
        minimum = -50,
        maximum = 50,
        max = 50,
        engineering_decimals = 3,
        hex_signed = true,
        modbus_counts_per_unit = 100,
    },
}

local LEGACY_UNTIL = "B1.4"

local SENTINELS = {
    {
        status = "over_range",
        format = "engineering",
        value = "+9999.9",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        not_legacy = true,
    },
    {
        status = "under_range",
        format = "engineering",
        value = "-9999.9",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        not_legacy = true,
    },
    {
        status = "over_range",
        format = "percent",
        value = "+999.99",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        not_legacy = true,
    },
    {
        status = "under_range",
        format = "percent",
        value = "-999.99",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        not_legacy = true,
    },
    {
        status = "over_range",
        format = "hex",
        value = "7FFF",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        not_legacy = true,
    },
    {
        status = "under_range",
        format = "hex",
        value = "8000",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        not_legacy = true,
    },
    {
        status = "over_range",
        format = "engineering",
        value = "+9999",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        legacy = true,
    },
    {
        status = "under_range",
        format = "engineering",
        value = "-0000",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        legacy = true,
    },
    {
        status = "over_range",
        format = "percent",
        value = "+9999",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        legacy = true,
    },
    {
        status = "under_range",
        format = "percent",
        value = "-0000",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        legacy = true,
    },
    {
        status = "over_range",
        format = "hex",
        value = "+9999",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        legacy = true,
    },
    {
        status = "under_range",
        format = "hex",
        value = "-0000",
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
        legacy = true,
    },
    { status = "under_range", format = "engineering", value = "-9999.9", types = { [7] = true } },
    { status = "under_range", format = "percent", value = "-999.99", types = { [7] = true } },
    { status = "under_range", format = "hex", value = "0000", types = { [7] = true } },
    {
        status = "over_range",
        format = "engineering",
        value = "+9999.9",
        types = {
            [0] = true,
            [1] = true,
            [2] = true,
            [3] = true,
            [4] = true,
            [5] = true,
            [6] = true,
            [7] = true,
            [8] = true,
            [9] = true,
            [10] = true,
            [11] = true,
            [12] = true,
            [13] = true,
            [26] = true,
            [27] = true,
            [28] = true,
        },
    },
    {
        status = "under_range",
        format = "engineering",
        value = "-9999.9",
        types = {
            [0] = true,
            [1] = true,
            [2] = true,
            [3] = true,
            [4] = true,
            [5] = true,
            [6] = true,
            [8] = true,
            [9] = true,
            [10] = true,
            [11] = true,
            [12] = true,
            [13] = true,
            [26] = true,
            [27] = true,
            [28] = true,
        },
    },
    {
        status = "over_range",
        format = "percent",
        value = "+999.99",
        types = {
            [0] = true,
            [1] = true,
            [2] = true,
            [3] = true,
            [4] = true,
            [5] = true,
            [6] = true,
            [7] = true,
            [8] = true,
            [9] = true,
            [10] = true,
            [11] = true,
            [12] = true,
            [13] = true,
            [26] = true,
            [27] = true,
            [28] = true,
        },
    },
    {
        status = "under_range",
        format = "percent",
        value = "-999.99",
        types = {
            [0] = true,
            [1] = true,
            [2] = true,
            [3] = true,
            [4] = true,
            [5] = true,
            [6] = true,
            [8] = true,
            [9] = true,
            [10] = true,
            [11] = true,
            [12] = true,
            [13] = true,
            [26] = true,
            [27] = true,
            [28] = true,
        },
    },
    {
        status = "over_range",
        format = "modbus_hex",
        value = 32767,
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
    },
    {
        status = "under_range",
        format = "modbus_hex",
        value = 32768,
        types = {
            [14] = true,
            [15] = true,
            [16] = true,
            [17] = true,
            [18] = true,
            [19] = true,
            [20] = true,
            [21] = true,
            [22] = true,
            [23] = true,
            [24] = true,
            [25] = true,
        },
    },
    { status = "under_range", format = "modbus_hex", value = 0, types = { [7] = true } },
    { status = "over_range", format = "modbus_engineering", value = 32767 },
    { status = "under_range", format = "modbus_engineering", value = -32768 },
    { status = "disabled", format = "engineering", value = "       " },
    { status = "disabled", format = "percent", value = "       " },
    { status = "disabled", format = "hex", value = "    " },
}

local BIT_SETTINGS = {
    { letters = "CC", low_bit = 0, bits = 6, code = 3, name = "1200 baud" },
    { letters = "CC", low_bit = 0, bits = 6, code = 4, name = "2400 baud" },
    { letters = "CC", low_bit = 0, bits = 6, code = 5, name = "4800 baud" },
    { letters = "CC", low_bit = 0, bits = 6, code = 6, name = "9600 baud" },
    { letters = "CC", low_bit = 0, bits = 6, code = 7, name = "19200 baud" },
    { letters = "CC", low_bit = 0, bits = 6, code = 8, name = "38400 baud" },
    { letters = "CC", low_bit = 0, bits = 6, code = 9, name = "57600 baud" },
    { letters = "CC", low_bit = 0, bits = 6, code = 10, name = "115200 baud" },
    { letters = "CC", low_bit = 6, bits = 2, code = 0, name = "no parity, 1 stop bit" },
    {
        letters = "CC",
        low_bit = 6,
        bits = 2,
        code = 1,
        name = "no parity, 2 stop bits",
        firmware = { ["7017"] = "B2.6", ["7018"] = "B2.9", ["7018Z"] = "B3.1", ["7019"] = "B3.1" },
    },
    {
        letters = "CC",
        low_bit = 6,
        bits = 2,
        code = 2,
        name = "even parity, 1 stop bit",
        firmware = { ["7017"] = "B2.6", ["7018"] = "B2.9", ["7018Z"] = "B3.1", ["7019"] = "B3.1" },
    },
    {
        letters = "CC",
        low_bit = 6,
        bits = 2,
        code = 3,
        name = "odd parity, 1 stop bit",
        firmware = { ["7017"] = "B2.6", ["7018"] = "B2.9", ["7018Z"] = "B3.1", ["7019"] = "B3.1" },
    },
    { letters = "FF", low_bit = 0, bits = 2, code = 0, name = "engineering units" },
    { letters = "FF", low_bit = 0, bits = 2, code = 1, name = "% of full scale range" },
    { letters = "FF", low_bit = 0, bits = 2, code = 2, name = "hexadecimal" },
    { letters = "FF", low_bit = 5, bits = 1, code = 0, name = "normal mode, 16 bits" },
    { letters = "FF", low_bit = 5, bits = 1, code = 1, name = "fast mode, 12 bits", needs = "fast_mode" },
    { letters = "FF", low_bit = 6, bits = 1, code = 0, name = "checksum disabled" },
    { letters = "FF", low_bit = 6, bits = 1, code = 1, name = "checksum enabled" },
    { letters = "FF", low_bit = 7, bits = 1, code = 0, name = "60 Hz rejection" },
    {
        letters = "FF",
        low_bit = 7,
        bits = 1,
        code = 1,
        name = "50 Hz rejection",
        firmware = { ["I-7019R"] = "B2.7", ["M-7019R"] = "B2.7" },
    },
    { letters = "FF", low_bit = 2, bits = 3, name = "reserved bits of FF, always zero" },
}

local BIT_GROUPS = { CC = 2, FF = 4 }

local CODE_NAMES = {
    protocol = { [0] = "DCON", [1] = "Modbus RTU" },
    update = { [0] = "stopped", [1] = "running", [2] = "once, when the command is received" },
    single_ended = { [false] = "differential", [true] = "single-ended" },
    modbus_supported = { [false] = "DCON only", [true] = "DCON and Modbus RTU" },
    first_reading = {
        [false] = "already read since the last sampling",
        [true] = "first reading since the last sampling",
    },
}

local DCON_COMMANDS = {
    {
        name = "SetConfiguration",
        section = "2.1",
        syntax = "%AANNTTCCFF",
        description = "Sets address, type code, line settings and report settings at once.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E16", "E17", "E20", "E34", "E81", "E82", "E89", "E101", "E107" },
        parts = {
            { literal = "%", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            {
                name = "new_address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address from now on",
                width = 2,
            },
            {
                name = "type_code",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "type code of every channel; FF where the channels differ; not used by models without uses_tt",
                legal = "types_or_mixed",
                width = 2,
            },
            {
                name = "line_settings",
                kind = "hex",
                minimum = 3,
                maximum = 202,
                meaning = "bits 5:0 baud rate code, bits 7:6 character format, see settings.json",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
                width = 2,
            },
            {
                name = "report_settings",
                kind = "hex",
                minimum = 0,
                maximum = 226,
                meaning = "bits 1:0 data format, bit 5 mode, bit 6 checksum, bit 7 filter, the others zero, see settings.json",
                legal = {
                    [0] = true,
                    [1] = true,
                    [2] = true,
                    [32] = true,
                    [33] = true,
                    [34] = true,
                    [64] = true,
                    [65] = true,
                    [66] = true,
                    [96] = true,
                    [97] = true,
                    [98] = true,
                    [128] = true,
                    [129] = true,
                    [130] = true,
                    [160] = true,
                    [161] = true,
                    [162] = true,
                    [192] = true,
                    [193] = true,
                    [194] = true,
                    [224] = true,
                    [225] = true,
                    [226] = true,
                },
                width = 2,
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            { name = "address", kind = "hex", minimum = 0, maximum = 255, meaning = "the new address", width = 2 },
        },
    },
    {
        name = "SynchronizedSampling",
        section = "2.2",
        syntax = "#**",
        description = "Makes every module that knows it sample all its inputs now and keep the readings for $AA4.",
        errata = { "E26", "E98", "E108" },
        parts = { { literal = "#**", width = 3 } },
        response_parts = {},
        models = { ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "ReadAnalogInputs",
        section = "2.3",
        syntax = "#AA",
        description = "Reads all channels in the data format set.",
        response = "AnalogInputs",
        response_syntax = ">(Data)",
        errata = { "E24", "E25", "E98" },
        parts = {
            { literal = "#", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
        },
        response_parts = {
            { literal = ">", width = 1 },
            {
                name = "values",
                kind = "readings",
                meaning = "one field a channel, as sent: 7 characters each in engineering and % format, 4 in hex; blanks for a disabled channel of the 7019 series",
                offset = 1,
                digits = { 4, 7 },
                digits_by = "reading_digits",
            },
        },
    },
    {
        name = "ReadAnalogInput",
        section = "2.4",
        syntax = "#AAN",
        description = "Reads one channel in the data format set.",
        response = "AnalogInput",
        response_syntax = ">(Data)",
        errata = { "E21", "E24", "E25", "E93", "E98" },
        parts = {
            { literal = "#", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            {
                name = "channel",
                kind = "hex",
                minimum = 0,
                maximum = 19,
                meaning = "channel, from 0; one digit, two on a 7017Z in single-ended mode",
                legal = "channels",
                offset = 3,
                digits = { 1, 2 },
                digits_by = "channel_digits",
            },
        },
        response_parts = {
            { literal = ">", width = 1 },
            {
                name = "value",
                kind = "reading",
                meaning = "the field of the channel, as sent: 7 characters in engineering and % format, 4 in hex; blanks for a disabled channel of the 7019 series",
                offset = 1,
                digits = { 4, 7 },
                digits_by = "reading_digits",
            },
        },
    },
    {
        name = "CalibrateSpan",
        section = "2.5",
        syntax = "$AA0",
        description = "Calibrates the span; calibration must have been enabled.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E09", "E33", "E34", "E86" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "0", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = {
            ["I-7017"] = false,
            ["I-7017F"] = false,
            ["I-7017C"] = false,
            ["I-7017FC"] = false,
            ["I-7017R"] = false,
            ["I-7017RC"] = false,
            ["I-7017R-A5"] = false,
            ["I-7017Z"] = false,
            ["M-7017"] = false,
            ["M-7017C"] = false,
            ["M-7017R"] = false,
            ["M-7017RC"] = false,
            ["M-7017R-A5"] = false,
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["I-7018"] = false,
            ["I-7018P"] = false,
            ["I-7018BL"] = false,
            ["I-7018R"] = false,
            ["I-7018Z"] = false,
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
        },
    },
    {
        name = "CalibrateZero",
        section = "2.6",
        syntax = "$AA1",
        description = "Calibrates the zero; calibration must have been enabled.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E09", "E33", "E34", "E86" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "1", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = {
            ["I-7017"] = false,
            ["I-7017F"] = false,
            ["I-7017C"] = false,
            ["I-7017FC"] = false,
            ["I-7017R"] = false,
            ["I-7017RC"] = false,
            ["I-7017R-A5"] = false,
            ["I-7017Z"] = false,
            ["M-7017"] = false,
            ["M-7017C"] = false,
            ["M-7017R"] = false,
            ["M-7017RC"] = false,
            ["M-7017R-A5"] = false,
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["I-7018"] = false,
            ["I-7018P"] = false,
            ["I-7018BL"] = false,
            ["I-7018R"] = false,
            ["I-7018Z"] = false,
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
        },
    },
    {
        name = "CalibrateCurrentChannelSpan",
        section = "2.7",
        syntax = "$AA0Ci",
        description = "Calibrates the span of one current input; calibration must have been enabled.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E07", "E09", "E33", "E86", "E87" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "0C", width = 2 },
            {
                name = "channel",
                kind = "hex",
                minimum = 0,
                maximum = 15,
                meaning = "channel, from 0",
                legal = "channels",
                width = 1,
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = { ["M-7017mC-16"] = false },
    },
    {
        name = "CalibrateChannelZero",
        section = "2.8",
        syntax = "$AA0Ci",
        description = "Calibrates the zero of one channel; calibration must have been enabled.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E07", "E09", "E33", "E86", "E87" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "0C", width = 2 },
            {
                name = "channel",
                kind = "hex",
                minimum = 0,
                maximum = 9,
                meaning = "channel, from 0",
                legal = "channels",
                width = 1,
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = { ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "CalibrateChannelSpan",
        section = "2.9",
        syntax = "$AA1Ci",
        description = "Calibrates the span of one channel; calibration must have been enabled.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E09", "E33", "E86" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "1C", width = 2 },
            {
                name = "channel",
                kind = "hex",
                minimum = 0,
                maximum = 9,
                meaning = "channel, from 0",
                legal = "channels",
                width = 1,
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = { ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "ReadConfiguration",
        section = "2.10",
        syntax = "$AA2",
        description = "Reads type code, line settings and report settings.",
        response = "Configuration",
        response_syntax = "!AATTCCFF",
        errata = { "E04", "E18", "E19", "E81", "E101" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "2", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "type_code",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "type code of the channels; FF where they differ",
                legal = "types_or_mixed",
                width = 2,
            },
            {
                name = "line_settings",
                kind = "hex",
                minimum = 3,
                maximum = 202,
                meaning = "bits 5:0 baud rate code, bits 7:6 character format, see settings.json",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
                width = 2,
            },
            {
                name = "report_settings",
                kind = "hex",
                minimum = 0,
                maximum = 226,
                meaning = "bits 1:0 data format, bit 5 mode, bit 6 checksum, bit 7 filter, the others zero, see settings.json",
                legal = {
                    [0] = true,
                    [1] = true,
                    [2] = true,
                    [32] = true,
                    [33] = true,
                    [34] = true,
                    [64] = true,
                    [65] = true,
                    [66] = true,
                    [96] = true,
                    [97] = true,
                    [98] = true,
                    [128] = true,
                    [129] = true,
                    [130] = true,
                    [160] = true,
                    [161] = true,
                    [162] = true,
                    [192] = true,
                    [193] = true,
                    [194] = true,
                    [224] = true,
                    [225] = true,
                    [226] = true,
                },
                width = 2,
            },
        },
    },
    {
        name = "ReadCjcTemperature",
        section = "2.11",
        syntax = "$AA3",
        description = "Reads the temperature of the cold junction; on the 7018 series with the CJC offset in it, on the 7019 series without.",
        response = "CjcTemperature",
        response_syntax = ">(Data)",
        errata = { "E24", "E29", "E87" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "3", width = 1 },
        },
        response_parts = {
            { literal = ">", width = 1 },
            {
                name = "temperature",
                kind = "decimal",
                minimum = -9999.9,
                maximum = 9999.9,
                meaning = "sign and five digits, the last after the point, whatever the data format",
                unit = "degC",
                width = 7,
            },
        },
        models = {
            ["I-7018"] = false,
            ["I-7018P"] = false,
            ["I-7018BL"] = false,
            ["I-7018R"] = false,
            ["I-7018Z"] = false,
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["I-7019R"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
    },
    {
        name = "ReadSynchronizedData",
        section = "2.12",
        syntax = "$AA4",
        description = "Reads what the last #** sampled; refused before the first.",
        response = "SynchronizedData",
        response_syntax = ">AAS(Data)",
        errata = { "E15", "E24", "E25", "E98", "E108" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "4", width = 1 },
        },
        response_parts = {
            { literal = ">", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "first_reading",
                kind = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "1 the first time these readings are read, else 0",
                width = 1,
            },
            {
                name = "values",
                kind = "readings",
                meaning = "one field a channel, as sent: 7 characters each in engineering and % format, 4 in hex; blanks for a disabled channel of the 7019 series",
                offset = 4,
                digits = { 4, 7 },
                digits_by = "reading_digits",
            },
        },
        models = { ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "SetChannelMask",
        section = "2.13",
        syntax = "$AA5VV",
        description = "Enables the channels of the mask and disables the others; refused where the mask names a channel that the module lacks.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E11", "E12", "E93" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "5", width = 1 },
            {
                name = "mask",
                kind = "hex",
                minimum = 0,
                maximum = 1048575,
                meaning = "bit n is 1 where channel n is enabled; width and channels by model and connecting mode, see models.json",
                legal = "channel_bits",
                offset = 4,
                digits = { 2, 4, 6 },
                digits_by = "mask_digits",
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
    },
    {
        name = "ReadChannelMask",
        section = "2.14",
        syntax = "$AA6",
        description = "Reads which channels are enabled.",
        response = "ChannelMask",
        response_syntax = "!AAVV",
        errata = { "E11", "E12" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "6", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "mask",
                kind = "hex",
                minimum = 0,
                maximum = 1048575,
                meaning = "bit n is 1 where channel n is enabled; width and channels by model and connecting mode, see models.json",
                legal = "channel_bits",
                offset = 3,
                digits = { 2, 4, 6 },
                digits_by = "mask_digits",
            },
        },
    },
    {
        name = "SetChannelTypeCode",
        section = "2.15",
        syntax = "$AA7CiRrr",
        description = "Sets the type code of one channel.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E22", "E23", "E60", "E68" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "7C", width = 2 },
            {
                name = "channel",
                kind = "hex",
                minimum = 0,
                maximum = 19,
                meaning = "channel, from 0; one digit, two on a 7017Z in single-ended mode",
                legal = "channels",
                offset = 5,
                digits = { 1, 2 },
                digits_by = "channel_digits",
            },
            { literal = "R", width = 1 },
            {
                name = "type_code",
                kind = "hex",
                minimum = 0,
                maximum = 26,
                meaning = "type code of the channel, see type_codes.json and models.json",
                legal = "types",
                width = 2,
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = {
            ["I-7017R"] = "B3.9",
            ["I-7017Z"] = false,
            ["M-7017R"] = "B3.9",
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["I-7018R"] = "B4.2",
            ["I-7018Z"] = false,
            ["M-7018R"] = "B4.5",
            ["M-7018Z"] = false,
            ["I-7019R"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
    },
    {
        name = "ReadChannelTypeCode",
        section = "2.16",
        syntax = "$AA8Ci",
        description = "Reads the type code of one channel.",
        response = "ChannelTypeCode",
        response_syntax = "!AACiRrr",
        errata = { "E22", "E87" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "8C", width = 2 },
            {
                name = "channel",
                kind = "hex",
                minimum = 0,
                maximum = 19,
                meaning = "channel, from 0; one digit, two on a 7017Z in single-ended mode",
                legal = "channels",
                offset = 5,
                digits = { 1, 2 },
                digits_by = "channel_digits",
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            { literal = "C", width = 1 },
            {
                name = "channel",
                kind = "hex",
                minimum = 0,
                maximum = 19,
                meaning = "channel, from 0; one digit, two on a 7017Z in single-ended mode",
                legal = "channels",
                offset = 4,
                digits = { 1, 2 },
                digits_by = "channel_digits",
            },
            { literal = "R", width = 1 },
            {
                name = "type_code",
                kind = "hex",
                minimum = 0,
                maximum = 26,
                meaning = "type code of the channel, see type_codes.json and models.json",
                legal = "types",
                width = 2,
            },
        },
        models = {
            ["I-7017R"] = "B3.9",
            ["I-7017Z"] = false,
            ["M-7017R"] = "B3.9",
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["I-7018R"] = "B4.2",
            ["I-7018Z"] = false,
            ["M-7018R"] = "B4.5",
            ["M-7018Z"] = false,
            ["I-7019R"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
    },
    {
        name = "ReadCjcOffset",
        section = "2.17",
        syntax = "$AA9",
        description = "Reads the CJC offset.",
        response = "CjcOffset",
        response_syntax = "!AA(Data)",
        errata = { "E85" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "9", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "offset",
                kind = "signed_hex",
                minimum = -4096,
                maximum = 4096,
                meaning = "sign and four hexadecimal digits of the absolute value",
                unit = "degC",
                scale = { 0.01 },
                width = 5,
            },
        },
        models = {
            ["I-7018"] = false,
            ["I-7018P"] = false,
            ["I-7018BL"] = false,
            ["I-7018R"] = false,
            ["I-7018Z"] = false,
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["I-7019R"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
    },
    {
        name = "SetCjcOffset",
        section = "2.18",
        syntax = "$AA9SNNNN",
        description = "Sets the CJC offset.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E28", "E85", "E134" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "9", width = 1 },
            {
                name = "offset",
                kind = "signed_hex",
                minimum = -4096,
                maximum = 4096,
                meaning = "sign and four hexadecimal digits of the absolute value",
                unit = "degC",
                scale = { 0.01 },
                width = 5,
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = {
            ["I-7018"] = false,
            ["I-7018P"] = false,
            ["I-7018BL"] = false,
            ["I-7018R"] = false,
            ["I-7018Z"] = false,
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["I-7019R"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
    },
    {
        name = "ReadAnalogInputsHex",
        section = "2.19",
        syntax = "$AAA",
        description = "Reads all channels in hex, whatever the data format.",
        response = "AnalogInputsHex",
        response_syntax = ">(Data)",
        errata = { "E08", "E24", "E25", "E34" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "A", width = 1 },
        },
        response_parts = {
            { literal = ">", width = 1 },
            {
                name = "values",
                kind = "readings",
                meaning = "one field a channel, as sent, 4 characters each",
                offset = 1,
            },
        },
        models = {
            ["I-7017"] = false,
            ["I-7017F"] = false,
            ["I-7017C"] = false,
            ["I-7017FC"] = false,
            ["I-7017R"] = false,
            ["I-7017RC"] = false,
            ["I-7017R-A5"] = false,
            ["I-7017Z"] = false,
            ["M-7017"] = false,
            ["M-7017C"] = false,
            ["M-7017R"] = false,
            ["M-7017RC"] = false,
            ["M-7017R-A5"] = false,
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
        },
    },
    {
        name = "ReadCjcUpdate",
        section = "2.20",
        syntax = "$AAA",
        description = "Reads whether the CJC temperature is being updated.",
        response = "CjcUpdateSetting",
        response_syntax = "!AAi",
        errata = { "E08", "E115" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "A", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "update",
                kind = "code",
                minimum = 0,
                maximum = 2,
                meaning = "0 stopped, 1 running, 2 once",
                width = 1,
            },
        },
        models = { ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "SetCjcUpdate",
        section = "2.21",
        syntax = "$AAAi",
        description = "Stops or starts the updating of the CJC temperature, or updates it once.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E28", "E115" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "A", width = 1 },
            {
                name = "update",
                kind = "code",
                minimum = 0,
                maximum = 2,
                meaning = "0 stopped, 1 running, 2 once",
                width = 1,
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = { ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "ReadDiagnostics",
        section = "2.22",
        syntax = "$AAB",
        description = "Reads which enabled channels are over range, under range or open.",
        response = "Diagnostics",
        response_syntax = "!AANN",
        errata = { "E13", "E14", "E69" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "B", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "mask",
                kind = "hex",
                minimum = 0,
                maximum = 1023,
                meaning = "bit n is 1 where channel n is in fault; four digits on the M-7019Z",
                legal = "channel_bits",
                offset = 3,
                digits = { 2, 4 },
                digits_by = "mask_digits",
            },
        },
        models = { ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "ReadFirmwareVersion",
        section = "2.23",
        syntax = "$AAF",
        description = "Reads the firmware version.",
        response = "FirmwareVersion",
        response_syntax = "!AA(Data)",
        errata = { "E67", "E113", "E122" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "F", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "version",
                kind = "version",
                meaning = "text: a letter, a digit, a point and one or two digits, as A2.0",
                offset = 3,
                digits = { 4, 5 },
                digits_by = "length",
            },
        },
    },
    {
        name = "ReadModuleName",
        section = "2.24",
        syntax = "$AAM",
        description = "Reads the module name.",
        response = "ModuleName",
        response_syntax = "!AA(Name)",
        errata = { "E06", "E102", "E113", "E122" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "M", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "name",
                kind = "name",
                meaning = "printable ASCII, no leading character of a command or response among it, and not the text of another response",
                offset = 3,
                digits = { 1, 2, 3, 4, 5, 6 },
                digits_by = "length",
            },
        },
    },
    {
        name = "ReadProtocol",
        section = "2.25",
        syntax = "$AAP",
        description = "Reads which protocols there are and which one the next power-on starts.",
        response = "ProtocolSetting",
        response_syntax = "!AASC",
        errata = { "E92" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "P", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "modbus_supported",
                kind = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "1 where Modbus RTU is supported beside DCON",
                width = 1,
            },
            {
                name = "protocol",
                kind = "code",
                minimum = 0,
                maximum = 1,
                meaning = "0 DCON, 1 Modbus RTU, after the next power-on",
                width = 1,
            },
        },
        models = {
            ["M-7017"] = false,
            ["M-7017C"] = false,
            ["M-7017R"] = false,
            ["M-7017RC"] = false,
            ["M-7017R-A5"] = false,
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
    },
    {
        name = "SetProtocol",
        section = "2.26",
        syntax = "$AAPN",
        description = "Sets the protocol that the next power-on starts; needs the INIT switch.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E17", "E28", "E82", "E91" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "P", width = 1 },
            { name = "protocol", kind = "code", minimum = 0, maximum = 1, meaning = "0 DCON, 1 Modbus RTU", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = {
            ["M-7017"] = false,
            ["M-7017C"] = false,
            ["M-7017R"] = false,
            ["M-7017RC"] = false,
            ["M-7017R-A5"] = false,
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
    },
    {
        name = "CalibrateInternally",
        section = "2.27",
        syntax = "$AAS0",
        description = "Calibrates the module against its own reference.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = {},
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "S0", width = 2 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = { ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "ReloadDefaultCalibration",
        section = "2.28",
        syntax = "$AAS1",
        description = "Brings back the factory calibration, the internal one included.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E103" },
        parts = {
            { literal = "$", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "S1", width = 2 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = { ["M-7017mC-16"] = false, ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "ReadCjcEnabled",
        section = "2.29",
        syntax = "~AAC",
        description = "Reads whether the cold junction compensation is enabled.",
        response = "CjcEnabled",
        response_syntax = "!AAN",
        errata = {},
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "C", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            { name = "enabled", kind = "bool", minimum = 0, maximum = 1, meaning = "1 enabled, 0 disabled", width = 1 },
        },
        models = {
            ["I-7018"] = false,
            ["I-7018P"] = false,
            ["I-7018BL"] = false,
            ["I-7018R"] = false,
            ["I-7018Z"] = false,
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["I-7019R"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
    },
    {
        name = "SetCjcEnabled",
        section = "2.30",
        syntax = "~AACN",
        description = "Enables or disables the cold junction compensation.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E28", "E116", "E134" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "C", width = 1 },
            { name = "enabled", kind = "bool", minimum = 0, maximum = 1, meaning = "1 enable, 0 disable", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = {
            ["I-7018"] = false,
            ["I-7018P"] = false,
            ["I-7018BL"] = false,
            ["I-7018R"] = false,
            ["I-7018Z"] = false,
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["I-7019R"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
    },
    {
        name = "SetCalibrationEnabled",
        section = "2.31",
        syntax = "~AAEV",
        description = "Enables or disables the calibration commands.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E10", "E33", "E87" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "E", width = 1 },
            { name = "enabled", kind = "bool", minimum = 0, maximum = 1, meaning = "1 enable, 0 disable", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
    },
    {
        name = "SoftInit",
        section = "2.32",
        syntax = "~AAI",
        description = "Opens the soft INIT window, in which baud rate and checksum may be set without the INIT switch.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E32", "E107" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "I", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = { ["M-7017mC-16"] = false, ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "SetModuleName",
        section = "2.33",
        syntax = "~AAO(Name)",
        description = "Sets the module name.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E10", "E102", "E122" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "O", width = 1 },
            {
                name = "name",
                kind = "name",
                meaning = "printable ASCII, no leading character of a command or response among it, and not the text of another response",
                offset = 4,
                digits = { 1, 2, 3, 4, 5, 6 },
                digits_by = "length",
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
    },
    {
        name = "SetSoftInitTimeout",
        section = "2.34",
        syntax = "~AATnn",
        description = "Sets how long the soft INIT window stays open; 0, the value after power-on, keeps it shut.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E20", "E32", "E107", "E138" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "T", width = 1 },
            {
                name = "timeout",
                kind = "hex",
                minimum = 0,
                maximum = 60,
                meaning = "soft INIT time-out",
                unit = "s",
                width = 2,
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = { ["M-7017mC-16"] = false, ["I-7019R"] = false, ["M-7019R"] = false, ["M-7019Z"] = false },
    },
    {
        name = "HostOk",
        section = "2.35",
        syntax = "~**",
        description = "Tells every module that the host is alive.",
        errata = { "E106" },
        parts = { { literal = "~**", width = 3 } },
        response_parts = {},
    },
    {
        name = "ReadHostWatchdogStatus",
        section = "2.36",
        syntax = "~AA0",
        description = "Reads whether the host watchdog is enabled and whether it has timed out.",
        response = "HostWatchdogStatus",
        response_syntax = "!AASS",
        errata = { "E30", "E31", "E106", "E114" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "0", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "status",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "bit 7 enabled, bit 2 timed out, the others undefined",
                width = 2,
            },
        },
    },
    {
        name = "ResetHostWatchdogStatus",
        section = "2.37",
        syntax = "~AA1",
        description = "Clears the time-out status of the host watchdog.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E30" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "1", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
    },
    {
        name = "ReadHostWatchdogTimeout",
        section = "2.38",
        syntax = "~AA2",
        description = "Reads whether the host watchdog is enabled and its time-out.",
        response = "HostWatchdogTimeout",
        response_syntax = "!AAEVV",
        errata = { "E05", "E100" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "2", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            { name = "enabled", kind = "bool", minimum = 0, maximum = 1, meaning = "1 enabled, 0 disabled", width = 1 },
            {
                name = "timeout",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "time-out",
                unit = "s",
                scale = { 0.1 },
                width = 2,
            },
        },
    },
    {
        name = "SetHostWatchdogTimeout",
        section = "2.39",
        syntax = "~AA3EVV",
        description = "Enables or disables the host watchdog and sets its time-out.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E05", "E100", "E138" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "3", width = 1 },
            { name = "enabled", kind = "bool", minimum = 0, maximum = 1, meaning = "1 enable, 0 disable", width = 1 },
            {
                name = "timeout",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "time-out",
                unit = "s",
                scale = { 0.1 },
                width = 2,
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
    },
    {
        name = "ReadOpenWireDetection",
        section = "2.40",
        syntax = "~AAEO",
        description = "Reads whether open wire detection is enabled.",
        response = "OpenWireDetection",
        response_syntax = "!AAN",
        errata = { "E01", "E10", "E68", "E69", "E132" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "EO", width = 2 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            { name = "enabled", kind = "bool", minimum = 0, maximum = 1, meaning = "1 enabled, 0 disabled", width = 1 },
        },
        models = {
            ["I-7018R"] = "B4.2",
            ["M-7018R"] = "B4.2",
            ["I-7019R"] = "B3.7",
            ["M-7019R"] = "B3.7",
            ["M-7019Z"] = "B3.7",
        },
    },
    {
        name = "SetOpenWireDetection",
        section = "2.41",
        syntax = "~AAEON",
        description = "Enables or disables open wire detection.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E02", "E10", "E28", "E68", "E69" },
        parts = {
            { literal = "~", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "EO", width = 2 },
            { name = "enabled", kind = "bool", minimum = 0, maximum = 1, meaning = "1 enable, 0 disable", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = {
            ["I-7018R"] = "B4.2",
            ["M-7018R"] = "B4.2",
            ["I-7019R"] = "B3.7",
            ["M-7019R"] = "B3.7",
            ["M-7019Z"] = "B3.7",
        },
    },
    {
        name = "ReadConnectingMode",
        section = "2.42",
        syntax = "@AAS",
        description = "Reads whether the inputs are differential or single-ended.",
        response = "ConnectingMode",
        response_syntax = "!AAN",
        errata = {},
        parts = {
            { literal = "@", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "S", width = 1 },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
            {
                name = "single_ended",
                kind = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "1 single-ended, 0 differential",
                width = 1,
            },
        },
        models = { ["I-7017Z"] = false, ["M-7017Z"] = false },
    },
    {
        name = "SetConnectingMode",
        section = "2.43",
        syntax = "@AASN",
        description = "Makes the inputs differential or single-ended.",
        response = "Acknowledged",
        response_syntax = "!AA",
        errata = { "E03", "E28" },
        parts = {
            { literal = "@", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the module",
                width = 2,
            },
            { literal = "S", width = 1 },
            {
                name = "single_ended",
                kind = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "1 single-ended, 0 differential",
                width = 1,
            },
        },
        response_parts = {
            { literal = "!", width = 1 },
            {
                name = "address",
                kind = "hex",
                minimum = 0,
                maximum = 255,
                meaning = "address of the responding module",
                width = 2,
            },
        },
        models = { ["I-7017Z"] = false, ["M-7017Z"] = false },
    },
}

local REFUSED_PARTS = {
    { literal = "?", width = 1 },
    {
        name = "address",
        kind = "hex",
        minimum = 0,
        maximum = 255,
        meaning = "address of the responding module",
        width = 2,
    },
}

local READINGS_PART = {
    name = "values",
    kind = "readings",
    meaning = "one field a channel, as sent: 7 characters each in engineering and % format, 4 in hex; blanks for a disabled channel of the 7019 series",
    offset = 1,
    digits = { 4, 7 },
    digits_by = "reading_digits",
}

local FUNCTIONS = {
    [1] = {
        name = "ReadCoils",
        section = "3.4",
        request = "01 start:2 count:2",
        response_name = "Coils",
        response = "01 bytes values:bits",
        description = "Reads coils.",
        errata = { "E55", "E94", "E120" },
        minimum_count = 1,
        maximum_count = 2000,
        broadcast = false,
        models = {
            ["M-7017"] = "B3.0",
            ["M-7017C"] = "B3.0",
            ["M-7017R"] = "B3.0",
            ["M-7017RC"] = "B3.0",
            ["M-7017R-A5"] = "B3.0",
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["M-7018"] = "B3.5",
            ["M-7018R"] = "B3.5",
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = "B3.0",
            ["M-7019Z"] = false,
        },
        request_fields = {
            start = {
                name = "start",
                kind = "unsigned",
                minimum = 0,
                maximum = 65535,
                meaning = "address of the first one",
            },
            count = { name = "count", kind = "unsigned", minimum = 1, maximum = 2000, meaning = "how many coils" },
        },
        response_fields = {
            values = { name = "values", kind = "bits", meaning = "the coils, the first in bit 0 of the first byte" },
        },
        exceptions = {
            [1] = "the module does not have the function",
            [2] = "start not in the map, or not for this access",
            [3] = "count out of its limits; another address not in the map, or not for this access; wrong number of bytes",
        },
    },
    [2] = {
        name = "ReadDiscreteInputs",
        section = "3.1",
        request = "02 start:2 count:2",
        response_name = "DiscreteInputs",
        response = "02 bytes values:bits",
        description = "Reads discrete inputs: which channels are out of range, or have an open wire.",
        errata = { "E56", "E57", "E58", "E84", "E94", "E99", "E120" },
        minimum_count = 1,
        maximum_count = 2000,
        broadcast = false,
        models = {
            ["M-7017"] = "B3.0",
            ["M-7017C"] = "B3.0",
            ["M-7017R"] = "B3.0",
            ["M-7017RC"] = "B3.0",
            ["M-7017R-A5"] = "B3.0",
            ["M-7017Z"] = false,
            ["M-7017mC-16"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
        request_fields = {
            start = {
                name = "start",
                kind = "unsigned",
                minimum = 0,
                maximum = 65535,
                meaning = "address of the first one",
            },
            count = { name = "count", kind = "unsigned", minimum = 1, maximum = 2000, meaning = "how many inputs" },
        },
        response_fields = {
            values = { name = "values", kind = "bits", meaning = "the inputs, the first in bit 0 of the first byte" },
        },
        exceptions = {
            [1] = "the module does not have the function",
            [2] = "start not in the map, or not for this access",
            [3] = "count out of its limits; another address not in the map, or not for this access; wrong number of bytes",
        },
    },
    [3] = {
        name = "ReadHoldingRegisters",
        section = "3.4",
        request = "03 start:2 count:2",
        response_name = "HoldingRegisters",
        response = "03 bytes values:words",
        description = "Reads holding registers.",
        errata = { "E55", "E94" },
        minimum_count = 1,
        maximum_count = 125,
        broadcast = false,
        models = {
            ["M-7017"] = "B3.0",
            ["M-7017C"] = "B3.0",
            ["M-7017R"] = "B3.0",
            ["M-7017RC"] = "B3.0",
            ["M-7017R-A5"] = "B3.0",
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["M-7018"] = "B3.5",
            ["M-7018R"] = "B3.5",
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = "B3.0",
            ["M-7019Z"] = false,
        },
        request_fields = {
            start = {
                name = "start",
                kind = "unsigned",
                minimum = 0,
                maximum = 65535,
                meaning = "address of the first one",
            },
            count = { name = "count", kind = "unsigned", minimum = 1, maximum = 125, meaning = "how many registers" },
        },
        response_fields = { values = { name = "values", kind = "words", meaning = "the registers" } },
        exceptions = {
            [1] = "the module does not have the function",
            [2] = "start not in the map, or not for this access",
            [3] = "count out of its limits; another address not in the map, or not for this access; wrong number of bytes",
        },
    },
    [4] = {
        name = "ReadInputRegisters",
        section = "3.2",
        request = "04 start:2 count:2",
        response_name = "InputRegisters",
        response = "04 bytes values:words",
        description = "Reads input registers: readings of channels, the CJC temperature, log records.",
        errata = { "E29", "E59", "E83", "E94", "E97", "E99", "E118" },
        minimum_count = 1,
        maximum_count = 125,
        broadcast = false,
        request_fields = {
            start = {
                name = "start",
                kind = "unsigned",
                minimum = 0,
                maximum = 65535,
                meaning = "address of the first one",
            },
            count = { name = "count", kind = "unsigned", minimum = 1, maximum = 125, meaning = "how many registers" },
        },
        response_fields = { values = { name = "values", kind = "words", meaning = "the registers" } },
        exceptions = {
            [1] = "the module does not have the function",
            [2] = "start not in the map, or not for this access",
            [3] = "count out of its limits; another address not in the map, or not for this access; wrong number of bytes",
        },
    },
    [5] = {
        name = "WriteSingleCoil",
        section = "3.4",
        request = "05 coil:2 value:2",
        response_name = "SingleCoilWritten",
        response = "05 coil:2 value:2",
        description = "Writes one coil: FF00 is 1, 0000 is 0.",
        errata = { "E55", "E94" },
        broadcast = true,
        models = {
            ["M-7017"] = "B3.0",
            ["M-7017C"] = "B3.0",
            ["M-7017R"] = "B3.0",
            ["M-7017RC"] = "B3.0",
            ["M-7017R-A5"] = "B3.0",
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["M-7018"] = "B3.5",
            ["M-7018R"] = "B3.5",
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = "B3.0",
            ["M-7019Z"] = false,
        },
        request_fields = {
            coil = { name = "coil", kind = "unsigned", minimum = 0, maximum = 65535, meaning = "address of the coil" },
            value = { name = "value", kind = "coil", meaning = "FF00 is true, 0000 is false" },
        },
        response_fields = {
            coil = { name = "coil", kind = "unsigned", minimum = 0, maximum = 65535, meaning = "address of the coil" },
            value = { name = "value", kind = "coil", meaning = "FF00 is true, 0000 is false" },
        },
        exceptions = {
            [1] = "the module does not have the function",
            [2] = "start not in the map, or not for this access",
            [3] = "value out of its limits; wrong number of bytes",
        },
    },
    [6] = {
        name = "WriteSingleRegister",
        section = "3.4",
        request = "06 register:2 value:2",
        response_name = "SingleRegisterWritten",
        response = "06 register:2 value:2",
        description = "Writes one holding register.",
        errata = { "E55", "E94" },
        broadcast = true,
        models = {
            ["M-7017"] = "B3.0",
            ["M-7017C"] = "B3.0",
            ["M-7017R"] = "B3.0",
            ["M-7017RC"] = "B3.0",
            ["M-7017R-A5"] = "B3.0",
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["M-7018"] = "B3.5",
            ["M-7018R"] = "B3.5",
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = "B3.0",
            ["M-7019Z"] = false,
        },
        request_fields = {
            register = {
                name = "register",
                kind = "unsigned",
                minimum = 0,
                maximum = 65535,
                meaning = "address of the register",
            },
            value = { name = "value", kind = "unsigned", minimum = 0, maximum = 65535, meaning = "the word" },
        },
        response_fields = {
            register = {
                name = "register",
                kind = "unsigned",
                minimum = 0,
                maximum = 65535,
                meaning = "address of the register",
            },
            value = { name = "value", kind = "unsigned", minimum = 0, maximum = 65535, meaning = "the word" },
        },
        exceptions = {
            [1] = "the module does not have the function",
            [2] = "start not in the map, or not for this access",
            [3] = "value out of its limits; wrong number of bytes",
        },
    },
    [15] = {
        name = "WriteMultipleCoils",
        section = "3.4",
        request = "0F start:2 count:2 bytes values:bits",
        response_name = "MultipleCoilsWritten",
        response = "0F start:2 count:2",
        description = "Writes coils.",
        errata = { "E55", "E94", "E120" },
        minimum_count = 1,
        maximum_count = 1968,
        broadcast = true,
        models = {
            ["M-7017"] = "B3.0",
            ["M-7017C"] = "B3.0",
            ["M-7017R"] = "B3.0",
            ["M-7017RC"] = "B3.0",
            ["M-7017R-A5"] = "B3.0",
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["M-7018"] = "B3.5",
            ["M-7018R"] = "B3.5",
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = "B3.0",
            ["M-7019Z"] = false,
        },
        request_fields = {
            start = {
                name = "start",
                kind = "unsigned",
                minimum = 0,
                maximum = 65535,
                meaning = "address of the first one",
            },
            values = { name = "values", kind = "bits", meaning = "the coils, the first in bit 0 of the first byte" },
        },
        response_fields = {
            start = {
                name = "start",
                kind = "unsigned",
                minimum = 0,
                maximum = 65535,
                meaning = "address of the first one",
            },
            count = {
                name = "count",
                kind = "unsigned",
                minimum = 1,
                maximum = 1968,
                meaning = "how many coils were written",
            },
        },
        exceptions = {
            [1] = "the module does not have the function",
            [2] = "start not in the map, or not for this access",
            [3] = "count out of its limits; another address not in the map, or not for this access; value out of its limits; wrong number of bytes",
        },
    },
    [16] = {
        name = "WriteMultipleRegisters",
        section = "3.4",
        request = "10 start:2 count:2 bytes values:words",
        response_name = "MultipleRegistersWritten",
        response = "10 start:2 count:2",
        description = "Writes holding registers; at most 11 at a time on the M-7019R and the M-7019Z.",
        errata = { "E55", "E94" },
        minimum_count = 1,
        maximum_count = 123,
        broadcast = true,
        models = {
            ["M-7017"] = "B3.0",
            ["M-7017C"] = "B3.0",
            ["M-7017R"] = "B3.0",
            ["M-7017RC"] = "B3.0",
            ["M-7017R-A5"] = "B3.0",
            ["M-7017Z"] = false,
            ["M-7017RMS"] = false,
            ["M-7017mC-16"] = false,
            ["M-7018"] = "B3.5",
            ["M-7018R"] = "B3.5",
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = "B3.0",
            ["M-7019Z"] = false,
        },
        request_fields = {
            start = {
                name = "start",
                kind = "unsigned",
                minimum = 0,
                maximum = 65535,
                meaning = "address of the first one",
            },
            values = { name = "values", kind = "words", meaning = "the registers" },
        },
        response_fields = {
            start = {
                name = "start",
                kind = "unsigned",
                minimum = 0,
                maximum = 65535,
                meaning = "address of the first one",
            },
            count = {
                name = "count",
                kind = "unsigned",
                minimum = 1,
                maximum = 123,
                meaning = "how many registers were written",
            },
        },
        exceptions = {
            [1] = "the module does not have the function",
            [2] = "start not in the map, or not for this access",
            [3] = "count out of its limits; another address not in the map, or not for this access; value out of its limits; wrong number of bytes",
        },
    },
}

local MODULE_SETTINGS = {
    [0] = {
        name = "ReadModuleName",
        section = "3.3.1",
        request = "46 00",
        response_name = "ModuleName",
        response = "46 00 name:4",
        description = "Reads the name of the series.",
        errata = { "E75", "E77" },
        request_fields = {},
        response_fields = {
            name = {
                name = "name",
                kind = "digits",
                meaning = "00701700 for the M-7017 series, 00701800 for the M-7018 series, 00701900 for the M-7019 series",
            },
        },
        exceptions = { [2] = "the module does not have the sub-function", [3] = "wrong number of bytes" },
    },
    [4] = {
        name = "SetModuleAddress",
        section = "3.3.2",
        request = "46 04 new_address 00 00 00",
        response_name = "ModuleAddressResult",
        response = "46 04 result 00 00 00",
        description = "Sets the address of the module.",
        errata = { "E90" },
        request_fields = {
            new_address = {
                name = "new_address",
                kind = "unsigned",
                minimum = 1,
                maximum = 247,
                meaning = "the new address",
            },
        },
        response_fields = {
            result = {
                name = "result",
                kind = "unsigned",
                minimum = 0,
                maximum = 255,
                meaning = "0 is done, anything else an error",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "new address out of its limits; a reserved byte that is not zero; wrong number of bytes",
        },
    },
    [5] = {
        name = "ReadCommunicationSettings",
        section = "3.3.3",
        request = "46 05 00",
        response_name = "CommunicationSettings",
        response = "46 05 00 line_settings 00 00 00 protocol 00 00",
        description = "Reads the communication settings as stored: those of the next power-on, not those in use.",
        errata = { "E44", "E65" },
        request_fields = {},
        response_fields = {
            line_settings = {
                name = "line_settings",
                kind = "unsigned",
                minimum = 3,
                maximum = 202,
                meaning = "as CC of settings.json: bits 5:0 baud rate 03 to 0A, bits 7:6 parity and stop bits",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            protocol = {
                name = "protocol",
                kind = "code",
                minimum = 0,
                maximum = 1,
                meaning = "0 is DCON, 1 is Modbus RTU",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "a reserved byte that is not zero; wrong number of bytes",
        },
    },
    [6] = {
        name = "SetCommunicationSettings",
        section = "3.3.4",
        request = "46 06 00 line_settings 00 00 00 protocol 00 00",
        response_name = "CommunicationSettingsResult",
        response = "46 06 00 line_result 00 00 00 protocol_result 00 00",
        description = "Sets the communication settings for the next power-on.",
        errata = { "E44", "E65", "E90", "E91" },
        request_fields = {
            line_settings = {
                name = "line_settings",
                kind = "unsigned",
                minimum = 3,
                maximum = 202,
                meaning = "as CC of settings.json: bits 5:0 baud rate 03 to 0A, bits 7:6 parity and stop bits",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            protocol = {
                name = "protocol",
                kind = "code",
                minimum = 0,
                maximum = 1,
                meaning = "0 is DCON, 1 is Modbus RTU",
            },
        },
        response_fields = {
            line_result = {
                name = "line_result",
                kind = "unsigned",
                minimum = 0,
                maximum = 255,
                meaning = "of the line settings: 0 is done, anything else an error",
            },
            protocol_result = {
                name = "protocol_result",
                kind = "unsigned",
                minimum = 0,
                maximum = 255,
                meaning = "of the protocol: 0 is done, anything else an error",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "baud rate or protocol out of its limits; a reserved byte that is not zero; wrong number of bytes",
        },
    },
    [7] = {
        name = "ReadTypeCode",
        section = "3.3.5",
        request = "46 07 00 channel",
        response_name = "TypeCodeSetting",
        response = "46 07 type_code",
        description = "Reads the type code of a channel, or of the module.",
        errata = { "E60" },
        request_fields = {
            channel = {
                name = "channel",
                kind = "unsigned",
                minimum = 0,
                maximum = 19,
                meaning = "channel, from 0; 0 on a module with one type for all channels",
                legal = "type_channels",
            },
        },
        response_fields = {
            type_code = {
                name = "type_code",
                kind = "unsigned",
                minimum = 0,
                maximum = 28,
                meaning = "type code, type_codes.json",
                legal = "types",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "a reserved byte that is not zero; channel that the module does not have; wrong number of bytes",
        },
    },
    [8] = {
        name = "SetTypeCode",
        section = "3.3.6",
        request = "46 08 00 channel type_code",
        response_name = "TypeCodeResult",
        response = "46 08 result",
        description = "Sets the type code of a channel, or of the module.",
        errata = { "E60", "E64", "E90" },
        request_fields = {
            channel = {
                name = "channel",
                kind = "unsigned",
                minimum = 0,
                maximum = 19,
                meaning = "channel, from 0; 0 on a module with one type for all channels",
                legal = "type_channels",
            },
            type_code = {
                name = "type_code",
                kind = "unsigned",
                minimum = 0,
                maximum = 28,
                meaning = "type code, type_codes.json",
                legal = "types",
            },
        },
        response_fields = {
            result = {
                name = "result",
                kind = "unsigned",
                minimum = 0,
                maximum = 255,
                meaning = "0 is done, anything else an error",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "type code that the module does not have; channel that the module does not have; a reserved byte that is not zero; wrong number of bytes",
        },
    },
    [32] = {
        name = "ReadFirmwareVersion",
        section = "3.3.7",
        request = "46 20",
        response_name = "FirmwareVersion",
        response = "46 20 major minor build",
        description = "Reads the firmware version.",
        errata = { "E75" },
        request_fields = {},
        response_fields = {
            major = { name = "major", kind = "unsigned", minimum = 0, maximum = 255, meaning = "major version" },
            minor = { name = "minor", kind = "unsigned", minimum = 0, maximum = 255, meaning = "minor version" },
            build = { name = "build", kind = "unsigned", minimum = 0, maximum = 255, meaning = "build" },
        },
        exceptions = { [2] = "the module does not have the sub-function", [3] = "wrong number of bytes" },
    },
    [37] = {
        name = "ReadChannelMask",
        section = "3.3.8",
        request = "46 25",
        response_name = "ChannelMask",
        response = "46 25 mask:mask",
        description = "Reads which channels are enabled.",
        errata = { "E12", "E61" },
        request_fields = {},
        response_fields = {
            mask = {
                name = "mask",
                kind = "unsigned",
                minimum = 0,
                maximum = 1048575,
                meaning = "enabled channels: bit 0 is channel 0",
                legal = "channel_bits",
            },
        },
        exceptions = { [2] = "the module does not have the sub-function", [3] = "wrong number of bytes" },
    },
    [38] = {
        name = "SetChannelMask",
        section = "3.3.9",
        request = "46 26 mask:mask",
        response_name = "ChannelMaskResult",
        response = "46 26 result",
        description = "Sets which channels are enabled.",
        errata = { "E12", "E61", "E90", "E97" },
        request_fields = {
            mask = {
                name = "mask",
                kind = "unsigned",
                minimum = 0,
                maximum = 1048575,
                meaning = "enabled channels: bit 0 is channel 0",
                legal = "channel_bits",
            },
        },
        response_fields = {
            result = {
                name = "result",
                kind = "unsigned",
                minimum = 0,
                maximum = 255,
                meaning = "0 is done, anything else an error",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "a bit of a channel that the module does not have; wrong number of bytes",
        },
    },
    [41] = {
        name = "ReadMiscellaneousSettings",
        section = "3.3.10",
        request = "46 29",
        response_name = "MiscellaneousSettings",
        response = "46 29 settings",
        description = "Reads filter and sampling mode.",
        errata = { "E43", "E88" },
        request_fields = {},
        response_fields = {
            settings = {
                name = "settings",
                kind = "unsigned",
                minimum = 0,
                maximum = 160,
                meaning = "bit 7 filter (0 is 60 Hz, 1 is 50 Hz rejection; reserved on the M-7019R up to B2.6), bit 5 mode (0 normal, 1 fast; reserved on models without fast mode), all others reserved and zero",
                legal = { [0] = true, [32] = true, [128] = true, [160] = true },
            },
        },
        exceptions = { [2] = "the module does not have the sub-function", [3] = "wrong number of bytes" },
    },
    [42] = {
        name = "SetMiscellaneousSettings",
        section = "3.3.11",
        request = "46 2A settings",
        response_name = "MiscellaneousSettingsResult",
        response = "46 2A result",
        description = "Sets filter and sampling mode.",
        errata = { "E43", "E88", "E90" },
        request_fields = {
            settings = {
                name = "settings",
                kind = "unsigned",
                minimum = 0,
                maximum = 160,
                meaning = "bit 7 filter (0 is 60 Hz, 1 is 50 Hz rejection; reserved on the M-7019R up to B2.6), bit 5 mode (0 normal, 1 fast; reserved on models without fast mode), all others reserved and zero",
                legal = { [0] = true, [32] = true, [128] = true, [160] = true },
            },
        },
        response_fields = {
            result = {
                name = "result",
                kind = "unsigned",
                minimum = 0,
                maximum = 255,
                meaning = "0 is done, anything else an error",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "a reserved bit that is not zero; wrong number of bytes",
        },
    },
    [43] = {
        name = "ReadCjcOffset",
        section = "3.3.12",
        request = "46 2B channel",
        response_name = "CjcOffset",
        response = "46 2B offset:2",
        description = "Reads the CJC offset of the module or of a channel.",
        errata = { "E62", "E63", "E85", "E104" },
        models = {
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
        request_fields = {
            channel = {
                name = "channel",
                kind = "unsigned",
                minimum = 0,
                maximum = 143,
                meaning = "00 is the module; 80 is channel 0, 81 channel 1 and so on, to 87, 89 or 8F",
                legal = "offset_channels",
            },
        },
        response_fields = {
            offset = {
                name = "offset",
                kind = "signed",
                minimum = -4096,
                maximum = 4096,
                meaning = "module: two's complement, 0.01 degC a count, -1000 to +1000 (hex); channel: 0.1 degC a count, two's complement in the low byte, high byte 00",
                legal = "offsets",
                unit = "degC",
                scale = { 0.01, 0.1 },
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "channel byte that means nothing; wrong number of bytes",
        },
    },
    [44] = {
        name = "SetCjcOffset",
        section = "3.3.13",
        request = "46 2C channel offset:2",
        response_name = "CjcOffsetResult",
        response = "46 2C result",
        description = "Sets the CJC offset of the module or of a channel.",
        errata = { "E62", "E63", "E85", "E90", "E104" },
        models = {
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
        request_fields = {
            channel = {
                name = "channel",
                kind = "unsigned",
                minimum = 0,
                maximum = 143,
                meaning = "00 is the module; 80 is channel 0, 81 channel 1 and so on, to 87, 89 or 8F",
                legal = "offset_channels",
            },
            offset = {
                name = "offset",
                kind = "signed",
                minimum = -4096,
                maximum = 4096,
                meaning = "module: two's complement, 0.01 degC a count, -1000 to +1000 (hex); channel: 0.1 degC a count, two's complement in the low byte, high byte 00",
                legal = "offsets",
                unit = "degC",
                scale = { 0.01, 0.1 },
            },
        },
        response_fields = {
            result = {
                name = "result",
                kind = "unsigned",
                minimum = 0,
                maximum = 255,
                meaning = "0 is done, anything else an error",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "channel byte that means nothing; offset out of its limits; wrong number of bytes",
        },
    },
    [45] = {
        name = "ReadCjcEnabled",
        section = "3.3.14",
        request = "46 2D 00",
        response_name = "CjcEnabled",
        response = "46 2D enabled",
        description = "Reads whether the CJC is enabled.",
        errata = { "E63" },
        models = {
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
        request_fields = {},
        response_fields = {
            enabled = {
                name = "enabled",
                kind = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "0 is disabled, 1 is enabled",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "a reserved byte that is not zero; wrong number of bytes",
        },
    },
    [46] = {
        name = "SetCjcEnabled",
        section = "3.3.15",
        request = "46 2E 00 enabled",
        response_name = "CjcEnabledResult",
        response = "46 2E result",
        description = "Enables or disables the CJC.",
        errata = { "E64", "E90" },
        models = {
            ["M-7018"] = false,
            ["M-7018R"] = false,
            ["M-7018Z"] = false,
            ["M-7018-16"] = false,
            ["M-7019R"] = false,
            ["M-7019Z"] = false,
        },
        request_fields = {
            enabled = { name = "enabled", kind = "bool", minimum = 0, maximum = 1, meaning = "0 disables, 1 enables" },
        },
        response_fields = {
            result = {
                name = "result",
                kind = "unsigned",
                minimum = 0,
                maximum = 255,
                meaning = "0 is done, anything else an error",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "a reserved byte that is not zero; setting that means nothing; wrong number of bytes",
        },
    },
    [47] = {
        name = "ReadCjcUpdate",
        section = "3.3.16",
        request = "46 2F",
        response_name = "CjcUpdateSetting",
        response = "46 2F update",
        description = "Reads how the CJC temperature is updated.",
        errata = { "E115" },
        models = { ["M-7019R"] = false, ["M-7019Z"] = false },
        request_fields = {},
        response_fields = {
            update = {
                name = "update",
                kind = "code",
                minimum = 0,
                maximum = 2,
                meaning = "0 stopped, 1 running, 2 once",
            },
        },
        exceptions = { [2] = "the module does not have the sub-function", [3] = "wrong number of bytes" },
    },
    [48] = {
        name = "SetCjcUpdate",
        section = "3.3.17",
        request = "46 30 update",
        response_name = "CjcUpdateResult",
        response = "46 30 result",
        description = "Sets how the CJC temperature is updated; 2 updates it once, when the request arrives.",
        errata = { "E64", "E90" },
        models = { ["M-7019R"] = false, ["M-7019Z"] = false },
        request_fields = {
            update = {
                name = "update",
                kind = "code",
                minimum = 0,
                maximum = 2,
                meaning = "0 stopped, 1 running, 2 once",
            },
        },
        response_fields = {
            result = {
                name = "result",
                kind = "unsigned",
                minimum = 0,
                maximum = 255,
                meaning = "0 is done, anything else an error",
            },
        },
        exceptions = {
            [2] = "the module does not have the sub-function",
            [3] = "setting that means nothing; wrong number of bytes",
        },
    },
}

local EXCEPTION_FIELDS = {
    ["function"] = {
        name = "function",
        kind = "unsigned",
        minimum = 1,
        maximum = 127,
        meaning = "function of the request; bit 7 is set on the line and is not part of the value",
    },
    exception_code = {
        name = "exception_code",
        kind = "unsigned",
        minimum = 0,
        maximum = 255,
        meaning = "why the request was refused",
    },
}

local MAPS = {
    {
        models = {
            ["M-7017"] = true,
            ["M-7017C"] = true,
            ["M-7017R"] = true,
            ["M-7017RC"] = true,
            ["M-7017R-A5"] = true,
        },
        rows = {
            {
                name = "range_status",
                area = "discrete_input",
                address = 128,
                count = 8,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Channels 0 to 7: a current of type 07 or 1A out of range.",
                values = { [0] = "in range, or disabled", [1] = "over or under range" },
            },
            {
                name = "range_status",
                area = "coil",
                address = 128,
                count = 8,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Channels 0 to 7: a current of type 07 or 1A out of range.",
                values = { [0] = "in range, or disabled", [1] = "over or under range" },
            },
            {
                name = "analog_input",
                area = "input_register",
                address = 0,
                count = 8,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 7.",
            },
            {
                name = "analog_input",
                area = "holding_register",
                address = 0,
                count = 8,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 7.",
            },
            {
                name = "type_code",
                area = "holding_register",
                address = 256,
                count = 8,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type codes of channels 0 to 7, type_codes.json.",
                firmware = "B3.9",
                legal = "types",
                models = { ["M-7017R"] = true },
            },
            {
                name = "firmware_version",
                area = "holding_register",
                address = 480,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Firmware version: low word, then high word.",
            },
            {
                name = "module_name",
                area = "holding_register",
                address = 482,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Name of the module: low word, then high word.",
            },
            {
                name = "module_address",
                area = "holding_register",
                address = 484,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 247,
                meaning = "Address of the module.",
            },
            {
                name = "line_settings",
                area = "holding_register",
                address = 485,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 3,
                maximum = 202,
                meaning = "Bits 5:0 baud rate, 03 to 0A; bits 7:6 parity and stop bits: 0 none and 1, 1 none and 2, 2 even and 1, 3 odd and 1. The codes are those of CC, settings.json.",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            {
                name = "module_type_code",
                area = "holding_register",
                address = 486,
                count = 1,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type code of the whole module, type_codes.json.",
                legal = "types",
            },
            {
                name = "response_delay",
                area = "holding_register",
                address = 487,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "ms",
                scale = 1,
                minimum = 0,
                maximum = 30,
                meaning = "How long the module waits before it answers.",
            },
            {
                name = "host_watchdog_timeout",
                area = "holding_register",
                address = 488,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "s",
                scale = 0.1,
                minimum = 0,
                maximum = 255,
                meaning = "Time-out of the host watchdog.",
            },
            {
                name = "channel_mask",
                area = "holding_register",
                address = 489,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 0,
                maximum = 255,
                meaning = "Enabled channels: bit 0 is channel 0.",
                legal = "channel_bits",
            },
            {
                name = "host_watchdog_timeout_count",
                area = "holding_register",
                address = 491,
                count = 1,
                access = "R/W",
                type = "uint16",
                meaning = "How often the host watchdog has timed out; writing 0 clears it.",
                legal = { [0] = true },
            },
            {
                name = "protocol",
                area = "coil",
                address = 256,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Protocol of the module.",
                values = { [0] = "DCON", [1] = "Modbus RTU" },
            },
            {
                name = "filter",
                area = "coil",
                address = 258,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Filter against mains hum.",
                values = { [0] = "60 Hz rejection", [1] = "50 Hz rejection" },
            },
            {
                name = "host_watchdog_enabled",
                area = "coil",
                address = 260,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Host watchdog.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "modbus_data_format",
                area = "coil",
                address = 268,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Format of the analog input registers.",
                values = { [0] = "hex", [1] = "engineering" },
            },
            {
                name = "host_watchdog_timed_out",
                area = "coil",
                address = 269,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Time-out status of the host watchdog.",
                legal = { [1] = true },
                values = { [0] = "not timed out", [1] = "timed out; writing 1 clears it" },
            },
            {
                name = "fast_mode",
                area = "coil",
                address = 270,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Sampling mode; printed for M-7017R and M-7017R-A5.",
                values = { [0] = "normal mode", [1] = "fast mode" },
                models = { ["M-7017R"] = true, ["M-7017RC"] = true, ["M-7017R-A5"] = true },
            },
            {
                name = "reset_status",
                area = "coil",
                address = 272,
                count = 1,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Whether the module was reset since this was last read.",
                values = { [0] = "read before since power-on", [1] = "first read since power-on" },
            },
        },
    },
    {
        models = { ["M-7017RMS"] = true },
        rows = {
            {
                name = "analog_input",
                area = "input_register",
                address = 0,
                count = 8,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 7.",
            },
            {
                name = "analog_input",
                area = "holding_register",
                address = 0,
                count = 8,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 7.",
            },
            {
                name = "type_code",
                area = "holding_register",
                address = 256,
                count = 8,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type codes of channels 0 to 7, type_codes.json.",
                legal = "types",
            },
            {
                name = "firmware_version",
                area = "holding_register",
                address = 480,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Firmware version: low word, then high word.",
            },
            {
                name = "module_name",
                area = "holding_register",
                address = 482,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Name of the module: low word, then high word.",
            },
            {
                name = "module_address",
                area = "holding_register",
                address = 484,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 247,
                meaning = "Address of the module.",
            },
            {
                name = "line_settings",
                area = "holding_register",
                address = 485,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 3,
                maximum = 202,
                meaning = "Bits 5:0 baud rate, 03 to 0A; bits 7:6 parity and stop bits: 0 none and 1, 1 none and 2, 2 even and 1, 3 odd and 1. The codes are those of CC, settings.json.",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            {
                name = "module_type_code",
                area = "holding_register",
                address = 486,
                count = 1,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type code of the whole module, type_codes.json.",
                legal = "types",
            },
            {
                name = "response_delay",
                area = "holding_register",
                address = 487,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "ms",
                scale = 1,
                minimum = 0,
                maximum = 30,
                meaning = "How long the module waits before it answers.",
            },
            {
                name = "host_watchdog_timeout",
                area = "holding_register",
                address = 488,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "s",
                scale = 0.1,
                minimum = 0,
                maximum = 255,
                meaning = "Time-out of the host watchdog.",
            },
            {
                name = "channel_mask",
                area = "holding_register",
                address = 489,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 0,
                maximum = 255,
                meaning = "Enabled channels: bit 0 is channel 0.",
                legal = "channel_bits",
            },
            {
                name = "host_watchdog_timeout_count",
                area = "holding_register",
                address = 491,
                count = 1,
                access = "R/W",
                type = "uint16",
                meaning = "How often the host watchdog has timed out; writing 0 clears it.",
                legal = { [0] = true },
            },
            {
                name = "protocol",
                area = "coil",
                address = 256,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Protocol of the module.",
                values = { [0] = "DCON", [1] = "Modbus RTU" },
            },
            {
                name = "filter",
                area = "coil",
                address = 258,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Filter against mains hum.",
                values = { [0] = "60 Hz rejection", [1] = "50 Hz rejection" },
            },
            {
                name = "host_watchdog_enabled",
                area = "coil",
                address = 260,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Host watchdog.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "modbus_data_format",
                area = "coil",
                address = 268,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Format of the analog input registers.",
                values = { [0] = "hex", [1] = "engineering" },
            },
            {
                name = "host_watchdog_timed_out",
                area = "coil",
                address = 269,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Time-out status of the host watchdog.",
                legal = { [1] = true },
                values = { [0] = "not timed out", [1] = "timed out; writing 1 clears it" },
            },
            {
                name = "reset_status",
                area = "coil",
                address = 272,
                count = 1,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Whether the module was reset since this was last read.",
                values = { [0] = "read before since power-on", [1] = "first read since power-on" },
            },
        },
    },
    {
        models = { ["M-7017mC-16"] = true },
        rows = {
            {
                name = "analog_input",
                area = "input_register",
                address = 0,
                count = 16,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 15.",
            },
            {
                name = "analog_input",
                area = "holding_register",
                address = 0,
                count = 16,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 15.",
            },
            {
                name = "rtc_epoch",
                area = "holding_register",
                address = 16,
                count = 2,
                access = "R/W",
                type = "uint32",
                unit = "s",
                scale = 1,
                meaning = "Clock, in seconds since 1970.",
            },
            {
                name = "type_code",
                area = "holding_register",
                address = 256,
                count = 16,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type codes of channels 0 to 15, type_codes.json.",
                legal = "types",
            },
            {
                name = "firmware_version",
                area = "holding_register",
                address = 480,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Firmware version: low word, then high word.",
            },
            {
                name = "module_name",
                area = "holding_register",
                address = 482,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Name of the module: low word, then high word.",
            },
            {
                name = "module_address",
                area = "holding_register",
                address = 484,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 247,
                meaning = "Address of the module on RS-485.",
            },
            {
                name = "line_settings",
                area = "holding_register",
                address = 485,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 3,
                maximum = 202,
                meaning = "Bits 5:0 baud rate, 03 to 0A; bits 7:6 parity and stop bits: 0 none and 1, 1 none and 2, 2 even and 1, 3 odd and 1. The codes are those of CC, settings.json.",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            {
                name = "response_delay",
                area = "holding_register",
                address = 487,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "ms",
                scale = 1,
                minimum = 0,
                maximum = 30,
                meaning = "How long the module waits before it answers on RS-485.",
            },
            {
                name = "host_watchdog_timeout",
                area = "holding_register",
                address = 488,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "s",
                scale = 0.1,
                minimum = 0,
                maximum = 255,
                meaning = "Time-out of the host watchdog on RS-485.",
            },
            {
                name = "channel_mask",
                area = "holding_register",
                address = 489,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 0,
                maximum = 65535,
                meaning = "Enabled channels: bit 0 is channel 0.",
                legal = "channel_bits",
            },
            {
                name = "host_watchdog_timeout_count",
                area = "holding_register",
                address = 491,
                count = 1,
                access = "R/W",
                type = "uint16",
                meaning = "How often the host watchdog has timed out; writing 0 clears it.",
                legal = { [0] = true },
            },
            {
                name = "rtc_year",
                area = "holding_register",
                address = 864,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 2000,
                maximum = 2159,
                meaning = "Clock: year.",
            },
            {
                name = "rtc_month",
                area = "holding_register",
                address = 865,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 12,
                meaning = "Clock: month.",
            },
            {
                name = "rtc_date",
                area = "holding_register",
                address = 866,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 31,
                meaning = "Clock: day of the month.",
            },
            {
                name = "rtc_hour",
                area = "holding_register",
                address = 867,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 0,
                maximum = 23,
                meaning = "Clock: hour.",
            },
            {
                name = "rtc_minute",
                area = "holding_register",
                address = 868,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 0,
                maximum = 59,
                meaning = "Clock: minute.",
            },
            {
                name = "rtc_second",
                area = "holding_register",
                address = 869,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 0,
                maximum = 59,
                meaning = "Clock: second.",
            },
            {
                name = "log_last_index",
                area = "holding_register",
                address = 870,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Index of the newest log record.",
            },
            {
                name = "log_read_index",
                area = "holding_register",
                address = 872,
                count = 2,
                access = "R/W",
                type = "uint32",
                meaning = "Index of the log record to be read.",
            },
            {
                name = "log_status",
                area = "holding_register",
                address = 874,
                count = 1,
                access = "R",
                type = "code",
                minimum = 0,
                maximum = 1,
                meaning = "Whether the data logger runs.",
                values = { [0] = "stopped", [1] = "running" },
            },
            {
                name = "log_command",
                area = "holding_register",
                address = 875,
                count = 1,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 2,
                meaning = "Starts and stops the data logger.",
                values = { [0] = "stop", [1] = "run in continuous mode", [2] = "run in period mode" },
            },
            {
                name = "log_overwrite",
                area = "holding_register",
                address = 876,
                count = 1,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 1,
                meaning = "What the data logger does when it is full.",
                values = { [0] = "stop", [1] = "go on writing" },
            },
            {
                name = "log_period_hour",
                area = "holding_register",
                address = 877,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "h",
                scale = 1,
                minimum = 0,
                maximum = 24,
                meaning = "Sampling period of the data logger: hours.",
            },
            {
                name = "log_period_minute",
                area = "holding_register",
                address = 878,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "min",
                scale = 1,
                minimum = 0,
                maximum = 59,
                meaning = "Sampling period of the data logger: minutes.",
            },
            {
                name = "log_period_second",
                area = "holding_register",
                address = 879,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "s",
                scale = 1,
                minimum = 0,
                maximum = 59,
                meaning = "Sampling period of the data logger: seconds.",
            },
            {
                name = "log_start_year",
                area = "holding_register",
                address = 880,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 2000,
                maximum = 2159,
                meaning = "Logging in period mode, beginning: year.",
            },
            {
                name = "log_start_month",
                area = "holding_register",
                address = 881,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 12,
                meaning = "Logging in period mode, beginning: month.",
            },
            {
                name = "log_start_date",
                area = "holding_register",
                address = 882,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 31,
                meaning = "Logging in period mode, beginning: day of the month.",
            },
            {
                name = "log_start_hour",
                area = "holding_register",
                address = 883,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 0,
                maximum = 23,
                meaning = "Logging in period mode, beginning: hour.",
            },
            {
                name = "log_start_minute",
                area = "holding_register",
                address = 884,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 0,
                maximum = 59,
                meaning = "Logging in period mode, beginning: minute.",
            },
            {
                name = "log_start_second",
                area = "holding_register",
                address = 885,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 0,
                maximum = 59,
                meaning = "Logging in period mode, beginning: second.",
            },
            {
                name = "log_end_year",
                area = "holding_register",
                address = 886,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 2000,
                maximum = 2159,
                meaning = "Logging in period mode, end: year.",
            },
            {
                name = "log_end_month",
                area = "holding_register",
                address = 887,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 12,
                meaning = "Logging in period mode, end: month.",
            },
            {
                name = "log_end_date",
                area = "holding_register",
                address = 888,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 31,
                meaning = "Logging in period mode, end: day of the month.",
            },
            {
                name = "log_end_hour",
                area = "holding_register",
                address = 889,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 0,
                maximum = 23,
                meaning = "Logging in period mode, end: hour.",
            },
            {
                name = "log_end_minute",
                area = "holding_register",
                address = 890,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 0,
                maximum = 59,
                meaning = "Logging in period mode, end: minute.",
            },
            {
                name = "log_end_second",
                area = "holding_register",
                address = 891,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 0,
                maximum = 59,
                meaning = "Logging in period mode, end: second.",
            },
            {
                name = "log_records",
                area = "input_register",
                address = 1000,
                count = 108,
                access = "R",
                type = "record",
                meaning = "Log records, 18 registers each, to be read in multiples of 18: 16 analog inputs, then the time in 2 registers.",
            },
            {
                name = "log_records",
                area = "holding_register",
                address = 1000,
                count = 108,
                access = "R",
                type = "record",
                meaning = "Log records, 18 registers each, to be read in multiples of 18: 16 analog inputs, then the time in 2 registers.",
            },
            {
                name = "range_status",
                area = "discrete_input",
                address = 128,
                count = 16,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Channels 0 to 15: a current of type 07 or 1A out of range.",
                values = { [0] = "in range, or disabled", [1] = "over or under range" },
            },
            {
                name = "range_status",
                area = "coil",
                address = 128,
                count = 16,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Channels 0 to 15: a current of type 07 or 1A out of range.",
                values = { [0] = "in range, or disabled", [1] = "over or under range" },
            },
            {
                name = "protocol",
                area = "coil",
                address = 256,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Protocol of the module on RS-485.",
                values = { [0] = "DCON", [1] = "Modbus RTU" },
            },
            {
                name = "host_watchdog_enabled",
                area = "coil",
                address = 260,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Host watchdog on RS-485.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "modbus_data_format",
                area = "coil",
                address = 268,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Format of the analog input registers.",
                values = { [0] = "hex", [1] = "engineering" },
            },
            {
                name = "host_watchdog_timed_out",
                area = "coil",
                address = 269,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Time-out status of the host watchdog; with the Modbus RTU protocol only.",
                legal = { [1] = true },
                values = { [0] = "not timed out", [1] = "timed out; writing 1 clears it" },
            },
            {
                name = "fast_mode",
                area = "coil",
                address = 270,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Sampling mode.",
                values = { [0] = "normal mode", [1] = "fast mode" },
            },
            {
                name = "load_factory_calibration",
                area = "coil",
                address = 271,
                count = 1,
                access = "W",
                type = "bool",
                minimum = 1,
                maximum = 1,
                meaning = "Loads the calibration of the factory.",
                values = { [1] = "load the calibration of the factory" },
            },
            {
                name = "reset_status",
                area = "coil",
                address = 272,
                count = 1,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Whether the module was reset since this was last read.",
                values = { [0] = "read before since power-on", [1] = "first read since power-on" },
            },
            {
                name = "big_endian",
                area = "coil",
                address = 282,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Byte order; the map does not say of what.",
                values = { [0] = "little-endian", [1] = "big-endian" },
            },
        },
    },
    {
        models = { ["M-7017Z"] = true },
        rows = {
            {
                name = "range_status",
                area = "discrete_input",
                address = 128,
                count = 10,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Channels 0 to 9: a current of type 07 or 1A out of range.",
                values = { [0] = "in range, or disabled", [1] = "over or under range" },
            },
            {
                name = "range_status",
                area = "coil",
                address = 128,
                count = 10,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Channels 0 to 9: a current of type 07 or 1A out of range.",
                values = { [0] = "in range, or disabled", [1] = "over or under range" },
            },
            {
                name = "analog_input",
                area = "input_register",
                address = 0,
                count = 20,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 19.",
            },
            {
                name = "analog_input",
                area = "holding_register",
                address = 0,
                count = 20,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 19.",
            },
            {
                name = "type_code",
                area = "holding_register",
                address = 256,
                count = 20,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type codes of channels 0 to 19, type_codes.json.",
                legal = "types",
            },
            {
                name = "firmware_version",
                area = "holding_register",
                address = 480,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Firmware version: low word, then high word.",
            },
            {
                name = "module_name",
                area = "holding_register",
                address = 482,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Name of the module: low word, then high word.",
            },
            {
                name = "module_address",
                area = "holding_register",
                address = 484,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 247,
                meaning = "Address of the module.",
            },
            {
                name = "line_settings",
                area = "holding_register",
                address = 485,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 3,
                maximum = 202,
                meaning = "Bits 5:0 baud rate, 03 to 0A; bits 7:6 parity and stop bits: 0 none and 1, 1 none and 2, 2 even and 1, 3 odd and 1. The codes are those of CC, settings.json.",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            {
                name = "response_delay",
                area = "holding_register",
                address = 487,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "ms",
                scale = 1,
                minimum = 0,
                maximum = 30,
                meaning = "How long the module waits before it answers.",
            },
            {
                name = "host_watchdog_timeout",
                area = "holding_register",
                address = 488,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "s",
                scale = 0.1,
                minimum = 0,
                maximum = 255,
                meaning = "Time-out of the host watchdog.",
            },
            {
                name = "channel_mask",
                area = "holding_register",
                address = 489,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 0,
                maximum = 65535,
                meaning = "Enabled channels, low word: bit 0 is channel 0.",
                legal = "channel_bits",
            },
            {
                name = "host_watchdog_timeout_count",
                area = "holding_register",
                address = 491,
                count = 1,
                access = "R/W",
                type = "uint16",
                meaning = "How often the host watchdog has timed out; writing 0 clears it.",
                legal = { [0] = true },
            },
            {
                name = "channel_mask_high",
                area = "holding_register",
                address = 496,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 0,
                maximum = 15,
                meaning = "Enabled channels, high word: bit 0 is channel 16; the limit is that of 3.3.8.",
                legal = "channel_bits",
            },
            {
                name = "protocol",
                area = "coil",
                address = 256,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Protocol of the module.",
                values = { [0] = "DCON", [1] = "Modbus RTU" },
            },
            {
                name = "filter",
                area = "coil",
                address = 258,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Filter against mains hum.",
                values = { [0] = "60 Hz rejection", [1] = "50 Hz rejection" },
            },
            {
                name = "host_watchdog_mode",
                area = "coil",
                address = 259,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "How the time-out status is cleared; no effect on modules without outputs.",
                values = {
                    [0] = "as on the I-7000 series",
                    [1] = "analog and digital output commands clear the time-out status",
                },
            },
            {
                name = "host_watchdog_enabled",
                area = "coil",
                address = 260,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Host watchdog.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "modbus_data_format",
                area = "coil",
                address = 268,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Format of the analog input registers.",
                values = { [0] = "hex", [1] = "engineering" },
            },
            {
                name = "host_watchdog_timed_out",
                area = "coil",
                address = 269,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Time-out status of the host watchdog.",
                legal = { [1] = true },
                values = { [0] = "not timed out", [1] = "timed out; writing 1 clears it" },
            },
            {
                name = "fast_mode",
                area = "coil",
                address = 270,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Sampling mode.",
                values = { [0] = "normal mode", [1] = "fast mode" },
            },
            {
                name = "reset_status",
                area = "coil",
                address = 272,
                count = 1,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Whether the module was reset since this was last read.",
                values = { [0] = "read before since power-on", [1] = "first read since power-on" },
            },
            {
                name = "single_ended",
                area = "coil",
                address = 276,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Connecting mode: 10 differential or 20 single-ended inputs.",
                values = { [0] = "differential", [1] = "single-ended" },
            },
        },
    },
    {
        models = { ["M-7018"] = true, ["M-7018R"] = true },
        rows = {
            {
                name = "analog_input",
                area = "input_register",
                address = 0,
                count = 8,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 7.",
            },
            {
                name = "analog_input",
                area = "holding_register",
                address = 0,
                count = 8,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 7.",
            },
            {
                name = "cjc_temperature",
                area = "input_register",
                address = 128,
                count = 1,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                meaning = "Temperature of the cold junction.",
            },
            {
                name = "cjc_temperature",
                area = "holding_register",
                address = 128,
                count = 1,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                meaning = "Temperature of the cold junction.",
            },
            {
                name = "type_code",
                area = "holding_register",
                address = 256,
                count = 8,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type codes of channels 0 to 7, type_codes.json.",
                firmware = "B4.5",
                legal = "types",
                models = { ["M-7018R"] = true },
            },
            {
                name = "cjc_offset",
                area = "holding_register",
                address = 352,
                count = 8,
                access = "R/W",
                type = "int8",
                unit = "degC",
                scale = 0.1,
                minimum = -128,
                maximum = 127,
                meaning = "CJC offsets of channels 0 to 7: 1 is 0.1, 127 is 12.7, 255 is -0.1, 128 is -12.8 degC.",
            },
            {
                name = "firmware_version",
                area = "holding_register",
                address = 480,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Firmware version: low word, then high word.",
            },
            {
                name = "module_name",
                area = "holding_register",
                address = 482,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Name of the module: low word, then high word.",
            },
            {
                name = "module_address",
                area = "holding_register",
                address = 484,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 247,
                meaning = "Address of the module.",
            },
            {
                name = "line_settings",
                area = "holding_register",
                address = 485,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 3,
                maximum = 202,
                meaning = "Bits 5:0 baud rate, 03 to 0A; bits 7:6 parity and stop bits: 0 none and 1, 1 none and 2, 2 even and 1, 3 odd and 1. The codes are those of CC, settings.json.",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            {
                name = "module_type_code",
                area = "holding_register",
                address = 486,
                count = 1,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type code of the whole module, type_codes.json.",
                legal = "types",
            },
            {
                name = "response_delay",
                area = "holding_register",
                address = 487,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "ms",
                scale = 1,
                minimum = 0,
                maximum = 30,
                meaning = "How long the module waits before it answers.",
            },
            {
                name = "host_watchdog_timeout",
                area = "holding_register",
                address = 488,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "s",
                scale = 0.1,
                minimum = 0,
                maximum = 255,
                meaning = "Time-out of the host watchdog.",
            },
            {
                name = "channel_mask",
                area = "holding_register",
                address = 489,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 0,
                maximum = 255,
                meaning = "Enabled channels: bit 0 is channel 0.",
                legal = "channel_bits",
            },
            {
                name = "module_cjc_offset",
                area = "holding_register",
                address = 490,
                count = 1,
                access = "R/W",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                minimum = -4096,
                maximum = 4096,
                meaning = "CJC offset of the module; the limits are those of 3.3.13.",
            },
            {
                name = "host_watchdog_timeout_count",
                area = "holding_register",
                address = 491,
                count = 1,
                access = "R/W",
                type = "uint16",
                meaning = "How often the host watchdog has timed out; writing 0 clears it.",
                legal = { [0] = true },
            },
            {
                name = "protocol",
                area = "coil",
                address = 256,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Protocol of the module.",
                values = { [0] = "DCON", [1] = "Modbus RTU" },
            },
            {
                name = "filter",
                area = "coil",
                address = 258,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Filter against mains hum.",
                values = { [0] = "60 Hz rejection", [1] = "50 Hz rejection" },
            },
            {
                name = "host_watchdog_mode",
                area = "coil",
                address = 259,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "How the time-out status is cleared; no effect on modules without outputs.",
                values = {
                    [0] = "as on the I-7000 series",
                    [1] = "analog and digital output commands clear the time-out status",
                },
            },
            {
                name = "host_watchdog_enabled",
                area = "coil",
                address = 260,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Host watchdog.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "cjc_enabled",
                area = "coil",
                address = 267,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Cold junction compensation.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "modbus_data_format",
                area = "coil",
                address = 268,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Format of the analog input registers.",
                values = { [0] = "hex", [1] = "engineering" },
            },
            {
                name = "host_watchdog_timed_out",
                area = "coil",
                address = 269,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Time-out status of the host watchdog.",
                legal = { [1] = true },
                values = { [0] = "not timed out", [1] = "timed out; writing 1 clears it" },
            },
            {
                name = "reset_status",
                area = "coil",
                address = 272,
                count = 1,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Whether the module was reset since this was last read.",
                values = { [0] = "read before since power-on", [1] = "first read since power-on" },
            },
            {
                name = "open_wire_detection",
                area = "coil",
                address = 275,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Detection of broken thermocouple wires.",
                firmware = "B4.5",
                values = { [0] = "disabled", [1] = "enabled" },
                models = { ["M-7018R"] = true },
            },
        },
    },
    {
        models = { ["M-7018Z"] = true },
        rows = {
            {
                name = "analog_input",
                area = "input_register",
                address = 0,
                count = 10,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 9.",
            },
            {
                name = "analog_input",
                area = "holding_register",
                address = 0,
                count = 10,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 9.",
            },
            {
                name = "cjc_temperature",
                area = "input_register",
                address = 128,
                count = 1,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                meaning = "Temperature of the cold junction.",
            },
            {
                name = "cjc_temperature",
                area = "holding_register",
                address = 128,
                count = 1,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                meaning = "Temperature of the cold junction.",
            },
            {
                name = "type_code",
                area = "holding_register",
                address = 256,
                count = 10,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type codes of channels 0 to 9, type_codes.json.",
                legal = "types",
            },
            {
                name = "cjc_offset",
                area = "holding_register",
                address = 352,
                count = 10,
                access = "R/W",
                type = "int8",
                unit = "degC",
                scale = 0.1,
                minimum = -128,
                maximum = 127,
                meaning = "CJC offsets of channels 0 to 9: 1 is 0.1, 127 is 12.7, 255 is -0.1, 128 is -12.8 degC.",
            },
            {
                name = "firmware_version",
                area = "holding_register",
                address = 480,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Firmware version: low word, then high word.",
            },
            {
                name = "module_name",
                area = "holding_register",
                address = 482,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Name of the module: low word, then high word.",
            },
            {
                name = "module_address",
                area = "holding_register",
                address = 484,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 247,
                meaning = "Address of the module.",
            },
            {
                name = "line_settings",
                area = "holding_register",
                address = 485,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 3,
                maximum = 202,
                meaning = "Bits 5:0 baud rate, 03 to 0A; bits 7:6 parity and stop bits: 0 none and 1, 1 none and 2, 2 even and 1, 3 odd and 1. The codes are those of CC, settings.json.",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            {
                name = "response_delay",
                area = "holding_register",
                address = 487,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "ms",
                scale = 1,
                minimum = 0,
                maximum = 30,
                meaning = "How long the module waits before it answers.",
            },
            {
                name = "host_watchdog_timeout",
                area = "holding_register",
                address = 488,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "s",
                scale = 0.1,
                minimum = 0,
                maximum = 255,
                meaning = "Time-out of the host watchdog.",
            },
            {
                name = "channel_mask",
                area = "holding_register",
                address = 489,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 0,
                maximum = 1023,
                meaning = "Enabled channels: bit 0 is channel 0.",
                legal = "channel_bits",
            },
            {
                name = "module_cjc_offset",
                area = "holding_register",
                address = 490,
                count = 1,
                access = "R/W",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                minimum = -4096,
                maximum = 4096,
                meaning = "CJC offset of the module; the limits are those of 3.3.13.",
            },
            {
                name = "host_watchdog_timeout_count",
                area = "holding_register",
                address = 491,
                count = 1,
                access = "R/W",
                type = "uint16",
                meaning = "How often the host watchdog has timed out; writing 0 clears it.",
                legal = { [0] = true },
            },
            {
                name = "protocol",
                area = "coil",
                address = 256,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Protocol of the module.",
                values = { [0] = "DCON", [1] = "Modbus RTU" },
            },
            {
                name = "filter",
                area = "coil",
                address = 258,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Filter against mains hum.",
                values = { [0] = "60 Hz rejection", [1] = "50 Hz rejection" },
            },
            {
                name = "host_watchdog_mode",
                area = "coil",
                address = 259,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "How the time-out status is cleared; no effect on modules without outputs.",
                values = {
                    [0] = "as on the I-7000 series",
                    [1] = "analog and digital output commands clear the time-out status",
                },
            },
            {
                name = "host_watchdog_enabled",
                area = "coil",
                address = 260,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Host watchdog.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "cjc_enabled",
                area = "coil",
                address = 267,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Cold junction compensation.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "modbus_data_format",
                area = "coil",
                address = 268,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Format of the analog input registers.",
                values = { [0] = "hex", [1] = "engineering" },
            },
            {
                name = "host_watchdog_timed_out",
                area = "coil",
                address = 269,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Time-out status of the host watchdog.",
                legal = { [1] = true },
                values = { [0] = "not timed out", [1] = "timed out; writing 1 clears it" },
            },
            {
                name = "reset_status",
                area = "coil",
                address = 272,
                count = 1,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Whether the module was reset since this was last read.",
                values = { [0] = "read before since power-on", [1] = "first read since power-on" },
            },
            {
                name = "open_wire_detection",
                area = "coil",
                address = 275,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Detection of broken thermocouple wires.",
                firmware = "B4.4",
                values = { [0] = "disabled", [1] = "enabled" },
            },
        },
    },
    {
        models = { ["M-7018-16"] = true },
        rows = {
            {
                name = "analog_input",
                area = "input_register",
                address = 0,
                count = 16,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 15.",
            },
            {
                name = "analog_input",
                area = "holding_register",
                address = 0,
                count = 16,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 15.",
            },
            {
                name = "temperature",
                area = "input_register",
                address = 32,
                count = 16,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 1,
                meaning = "Temperatures of channels 0 to 15 in whole degrees.",
            },
            {
                name = "temperature",
                area = "holding_register",
                address = 32,
                count = 16,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 1,
                meaning = "Temperatures of channels 0 to 15 in whole degrees.",
            },
            {
                name = "cjc_temperature",
                area = "input_register",
                address = 128,
                count = 1,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                meaning = "Temperature of the cold junction.",
            },
            {
                name = "cjc_temperature",
                area = "holding_register",
                address = 128,
                count = 1,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                meaning = "Temperature of the cold junction.",
            },
            {
                name = "cjc_offset",
                area = "holding_register",
                address = 352,
                count = 16,
                access = "R/W",
                type = "int8",
                unit = "degC",
                scale = 0.1,
                minimum = -128,
                maximum = 127,
                meaning = "CJC offsets of channels 0 to 15: 1 is 0.1, 127 is 12.7, 255 is -0.1, 128 is -12.8 degC.",
            },
            {
                name = "firmware_version",
                area = "holding_register",
                address = 480,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Firmware version: low word, then high word.",
            },
            {
                name = "module_name",
                area = "holding_register",
                address = 482,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Name of the module: low word, then high word.",
            },
            {
                name = "module_address",
                area = "holding_register",
                address = 484,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 247,
                meaning = "Address of the module.",
            },
            {
                name = "line_settings",
                area = "holding_register",
                address = 485,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 3,
                maximum = 202,
                meaning = "Bits 5:0 baud rate, 03 to 0A; bits 7:6 parity and stop bits: 0 none and 1, 1 none and 2, 2 even and 1, 3 odd and 1. The codes are those of CC, settings.json.",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            {
                name = "module_type_code",
                area = "holding_register",
                address = 486,
                count = 1,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type code of the whole module, type_codes.json.",
                legal = "types",
            },
            {
                name = "response_delay",
                area = "holding_register",
                address = 487,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "ms",
                scale = 1,
                minimum = 0,
                maximum = 30,
                meaning = "How long the module waits before it answers.",
            },
            {
                name = "host_watchdog_timeout",
                area = "holding_register",
                address = 488,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "s",
                scale = 0.1,
                minimum = 0,
                maximum = 255,
                meaning = "Time-out of the host watchdog.",
            },
            {
                name = "channel_mask",
                area = "holding_register",
                address = 489,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 0,
                maximum = 65535,
                meaning = "Enabled channels: bit 0 is channel 0; printed 00 to FF.",
                legal = "channel_bits",
            },
            {
                name = "module_cjc_offset",
                area = "holding_register",
                address = 490,
                count = 1,
                access = "R/W",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                minimum = -4096,
                maximum = 4096,
                meaning = "CJC offset of the module; the limits are those of 3.3.13.",
            },
            {
                name = "host_watchdog_timeout_count",
                area = "holding_register",
                address = 491,
                count = 1,
                access = "R/W",
                type = "uint16",
                meaning = "How often the host watchdog has timed out; writing 0 clears it.",
                legal = { [0] = true },
            },
            {
                name = "protocol",
                area = "coil",
                address = 256,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Protocol of the module.",
                values = { [0] = "DCON", [1] = "Modbus RTU" },
            },
            {
                name = "filter",
                area = "coil",
                address = 258,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Filter against mains hum.",
                values = { [0] = "60 Hz rejection", [1] = "50 Hz rejection" },
            },
            {
                name = "host_watchdog_mode",
                area = "coil",
                address = 259,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "How the time-out status is cleared; no effect on modules without outputs.",
                values = {
                    [0] = "as on the I-7000 series",
                    [1] = "analog and digital output commands clear the time-out status",
                },
            },
            {
                name = "host_watchdog_enabled",
                area = "coil",
                address = 260,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Host watchdog.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "cjc_enabled",
                area = "coil",
                address = 267,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Cold junction compensation.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "modbus_data_format",
                area = "coil",
                address = 268,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Format of the analog input registers.",
                values = { [0] = "hex", [1] = "engineering" },
            },
            {
                name = "host_watchdog_timed_out",
                area = "coil",
                address = 269,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Time-out status of the host watchdog.",
                legal = { [1] = true },
                values = { [0] = "not timed out", [1] = "timed out; writing 1 clears it" },
            },
            {
                name = "reset_status",
                area = "coil",
                address = 272,
                count = 1,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Whether the module was reset since this was last read.",
                values = { [0] = "read before since power-on", [1] = "first read since power-on" },
            },
        },
    },
    {
        models = { ["M-7019R"] = true },
        rows = {
            {
                name = "range_status",
                area = "discrete_input",
                address = 128,
                count = 8,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Channels 0 to 7: out of range, or the wire is open.",
                values = { [0] = "in range, or disabled", [1] = "over or under range" },
            },
            {
                name = "range_status",
                area = "coil",
                address = 128,
                count = 8,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Channels 0 to 7: out of range, or the wire is open.",
                values = { [0] = "in range, or disabled", [1] = "over or under range" },
            },
            {
                name = "analog_input",
                area = "input_register",
                address = 0,
                count = 8,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 7.",
            },
            {
                name = "analog_input",
                area = "holding_register",
                address = 0,
                count = 8,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 7.",
            },
            {
                name = "cjc_temperature",
                area = "input_register",
                address = 128,
                count = 1,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                meaning = "Temperature of the cold junction.",
            },
            {
                name = "cjc_temperature",
                area = "holding_register",
                address = 128,
                count = 1,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                meaning = "Temperature of the cold junction.",
            },
            {
                name = "type_code",
                area = "holding_register",
                address = 256,
                count = 8,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type codes of channels 0 to 7, type_codes.json.",
                legal = "types",
            },
            {
                name = "temperature_offset",
                area = "holding_register",
                address = 288,
                count = 8,
                access = "R/W",
                type = "int16",
                unit = "degC",
                scale = 0.1,
                minimum = -128,
                maximum = 127,
                meaning = "Temperature offsets of channels 0 to 7.",
            },
            {
                name = "cjc_offset",
                area = "holding_register",
                address = 352,
                count = 8,
                access = "R/W",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                minimum = -4096,
                maximum = 4096,
                meaning = "CJC offsets of channels 0 to 7.",
            },
            {
                name = "firmware_version",
                area = "holding_register",
                address = 480,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Firmware version: low word, then high word.",
            },
            {
                name = "module_name",
                area = "holding_register",
                address = 482,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Name of the module: low word, then high word.",
            },
            {
                name = "module_address",
                area = "holding_register",
                address = 484,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 247,
                meaning = "Address of the module.",
            },
            {
                name = "line_settings",
                area = "holding_register",
                address = 485,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 3,
                maximum = 202,
                meaning = "Bits 5:0 baud rate, 03 to 0A; bits 7:6 parity and stop bits: 0 none and 1, 1 none and 2, 2 even and 1, 3 odd and 1. The codes are those of CC, settings.json.",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            {
                name = "response_delay",
                area = "holding_register",
                address = 487,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "ms",
                scale = 1,
                minimum = 0,
                maximum = 30,
                meaning = "How long the module waits before it answers.",
            },
            {
                name = "host_watchdog_timeout",
                area = "holding_register",
                address = 488,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "s",
                scale = 0.1,
                minimum = 0,
                maximum = 255,
                meaning = "Time-out of the host watchdog.",
            },
            {
                name = "channel_mask",
                area = "holding_register",
                address = 489,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 0,
                maximum = 255,
                meaning = "Enabled channels: bit 0 is channel 0.",
                legal = "channel_bits",
            },
            {
                name = "module_cjc_offset",
                area = "holding_register",
                address = 490,
                count = 1,
                access = "R/W",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                minimum = -4096,
                maximum = 4096,
                meaning = "CJC offset of the module; the limits are those of 3.3.13.",
            },
            {
                name = "host_watchdog_timeout_count",
                area = "holding_register",
                address = 491,
                count = 1,
                access = "R/W",
                type = "uint16",
                meaning = "How often the host watchdog has timed out; writing 0 clears it.",
                legal = { [0] = true },
            },
            {
                name = "cjc_update",
                area = "holding_register",
                address = 492,
                count = 1,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 2,
                meaning = "Update of the CJC temperature.",
                values = { [0] = "stopped", [1] = "running", [2] = "once" },
            },
            {
                name = "protocol",
                area = "coil",
                address = 256,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Protocol of the module.",
                values = { [0] = "DCON", [1] = "Modbus RTU" },
            },
            {
                name = "filter",
                area = "coil",
                address = 258,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Filter against mains hum.",
                values = { [0] = "60 Hz rejection", [1] = "50 Hz rejection" },
            },
            {
                name = "host_watchdog_mode",
                area = "coil",
                address = 259,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "How the time-out status is cleared; no effect on modules without outputs.",
                values = {
                    [0] = "as on the I-7000 series",
                    [1] = "analog and digital output commands clear the time-out status",
                },
            },
            {
                name = "host_watchdog_enabled",
                area = "coil",
                address = 260,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Host watchdog.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "cjc_enabled",
                area = "coil",
                address = 267,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Cold junction compensation.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "modbus_data_format",
                area = "coil",
                address = 268,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Format of the analog input registers.",
                values = { [0] = "hex", [1] = "engineering" },
            },
            {
                name = "host_watchdog_timed_out",
                area = "coil",
                address = 269,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Time-out status of the host watchdog.",
                legal = { [1] = true },
                values = { [0] = "not timed out", [1] = "timed out; writing 1 clears it" },
            },
            {
                name = "load_factory_calibration",
                area = "coil",
                address = 271,
                count = 1,
                access = "W",
                type = "bool",
                minimum = 1,
                maximum = 1,
                meaning = "Loads the calibration of the factory; about 3 seconds, in which nothing may be sent.",
                values = { [1] = "load the calibration of the factory" },
            },
            {
                name = "reset_status",
                area = "coil",
                address = 272,
                count = 1,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Whether the module was reset since this was last read.",
                values = { [0] = "read before since power-on", [1] = "first read since power-on" },
            },
            {
                name = "sampling_rate",
                area = "coil",
                address = 273,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Samples a second.",
                values = { [0] = "10 Hz", [1] = "8 Hz" },
            },
            {
                name = "open_wire_detection",
                area = "coil",
                address = 275,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Detection of broken thermocouple wires.",
                firmware = "B3.7",
                values = { [0] = "disabled", [1] = "enabled" },
            },
        },
    },
    {
        models = { ["M-7019Z"] = true },
        rows = {
            {
                name = "range_status",
                area = "discrete_input",
                address = 128,
                count = 10,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Channels 0 to 9: out of range, or the wire is open.",
                values = { [0] = "in range, or disabled", [1] = "over or under range" },
            },
            {
                name = "range_status",
                area = "coil",
                address = 128,
                count = 10,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Channels 0 to 9: out of range, or the wire is open.",
                values = { [0] = "in range, or disabled", [1] = "over or under range" },
            },
            {
                name = "analog_input",
                area = "input_register",
                address = 0,
                count = 10,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 9.",
            },
            {
                name = "analog_input",
                area = "holding_register",
                address = 0,
                count = 10,
                access = "R",
                type = "reading",
                meaning = "Readings of channels 0 to 9.",
            },
            {
                name = "cjc_temperature",
                area = "input_register",
                address = 128,
                count = 1,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                meaning = "Temperature of the cold junction.",
            },
            {
                name = "cjc_temperature",
                area = "holding_register",
                address = 128,
                count = 1,
                access = "R",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                meaning = "Temperature of the cold junction.",
            },
            {
                name = "type_code",
                area = "holding_register",
                address = 256,
                count = 10,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 28,
                meaning = "Type codes of channels 0 to 9, type_codes.json.",
                legal = "types",
            },
            {
                name = "temperature_offset",
                area = "holding_register",
                address = 288,
                count = 10,
                access = "R/W",
                type = "int16",
                unit = "degC",
                scale = 0.1,
                minimum = -128,
                maximum = 127,
                meaning = "Temperature offsets of channels 0 to 9.",
            },
            {
                name = "cjc_offset",
                area = "holding_register",
                address = 352,
                count = 10,
                access = "R/W",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                minimum = -4096,
                maximum = 4096,
                meaning = "CJC offsets of channels 0 to 9.",
            },
            {
                name = "firmware_version",
                area = "holding_register",
                address = 480,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Firmware version: low word, then high word.",
            },
            {
                name = "module_name",
                area = "holding_register",
                address = 482,
                count = 2,
                access = "R",
                type = "uint32",
                meaning = "Name of the module: low word, then high word.",
            },
            {
                name = "module_address",
                area = "holding_register",
                address = 484,
                count = 1,
                access = "R/W",
                type = "uint16",
                minimum = 1,
                maximum = 247,
                meaning = "Address of the module.",
            },
            {
                name = "line_settings",
                area = "holding_register",
                address = 485,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 3,
                maximum = 202,
                meaning = "Bits 5:0 baud rate, 03 to 0A; bits 7:6 parity and stop bits: 0 none and 1, 1 none and 2, 2 even and 1, 3 odd and 1. The codes are those of CC, settings.json.",
                legal = {
                    [3] = true,
                    [4] = true,
                    [5] = true,
                    [6] = true,
                    [7] = true,
                    [8] = true,
                    [9] = true,
                    [10] = true,
                    [67] = true,
                    [68] = true,
                    [69] = true,
                    [70] = true,
                    [71] = true,
                    [72] = true,
                    [73] = true,
                    [74] = true,
                    [131] = true,
                    [132] = true,
                    [133] = true,
                    [134] = true,
                    [135] = true,
                    [136] = true,
                    [137] = true,
                    [138] = true,
                    [195] = true,
                    [196] = true,
                    [197] = true,
                    [198] = true,
                    [199] = true,
                    [200] = true,
                    [201] = true,
                    [202] = true,
                },
            },
            {
                name = "response_delay",
                area = "holding_register",
                address = 487,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "ms",
                scale = 1,
                minimum = 0,
                maximum = 30,
                meaning = "How long the module waits before it answers.",
            },
            {
                name = "host_watchdog_timeout",
                area = "holding_register",
                address = 488,
                count = 1,
                access = "R/W",
                type = "uint16",
                unit = "s",
                scale = 0.1,
                minimum = 0,
                maximum = 255,
                meaning = "Time-out of the host watchdog.",
            },
            {
                name = "channel_mask",
                area = "holding_register",
                address = 489,
                count = 1,
                access = "R/W",
                type = "bits",
                minimum = 0,
                maximum = 1023,
                meaning = "Enabled channels: bit 0 is channel 0.",
                legal = "channel_bits",
            },
            {
                name = "module_cjc_offset",
                area = "holding_register",
                address = 490,
                count = 1,
                access = "R/W",
                type = "int16",
                unit = "degC",
                scale = 0.01,
                minimum = -4096,
                maximum = 4096,
                meaning = "CJC offset of the module; the limits are those of 3.3.13.",
            },
            {
                name = "host_watchdog_timeout_count",
                area = "holding_register",
                address = 491,
                count = 1,
                access = "R/W",
                type = "uint16",
                meaning = "How often the host watchdog has timed out; writing 0 clears it.",
                legal = { [0] = true },
            },
            {
                name = "cjc_update",
                area = "holding_register",
                address = 492,
                count = 1,
                access = "R/W",
                type = "code",
                minimum = 0,
                maximum = 2,
                meaning = "Update of the CJC temperature.",
                values = { [0] = "stopped", [1] = "running", [2] = "once" },
            },
            {
                name = "protocol",
                area = "coil",
                address = 256,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Protocol of the module.",
                values = { [0] = "DCON", [1] = "Modbus RTU" },
            },
            {
                name = "filter",
                area = "coil",
                address = 258,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Filter against mains hum.",
                values = { [0] = "60 Hz rejection", [1] = "50 Hz rejection" },
            },
            {
                name = "host_watchdog_mode",
                area = "coil",
                address = 259,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "How the time-out status is cleared; no effect on modules without outputs.",
                values = {
                    [0] = "as on the I-7000 series",
                    [1] = "analog and digital output commands clear the time-out status",
                },
            },
            {
                name = "host_watchdog_enabled",
                area = "coil",
                address = 260,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Host watchdog.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "cjc_enabled",
                area = "coil",
                address = 267,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Cold junction compensation.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
            {
                name = "modbus_data_format",
                area = "coil",
                address = 268,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Format of the analog input registers.",
                values = { [0] = "hex", [1] = "engineering" },
            },
            {
                name = "host_watchdog_timed_out",
                area = "coil",
                address = 269,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Time-out status of the host watchdog.",
                legal = { [1] = true },
                values = { [0] = "not timed out", [1] = "timed out; writing 1 clears it" },
            },
            {
                name = "load_factory_calibration",
                area = "coil",
                address = 271,
                count = 1,
                access = "W",
                type = "bool",
                minimum = 1,
                maximum = 1,
                meaning = "Loads the calibration of the factory; about 3 seconds, in which nothing may be sent.",
                values = { [1] = "load the calibration of the factory" },
            },
            {
                name = "reset_status",
                area = "coil",
                address = 272,
                count = 1,
                access = "R",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Whether the module was reset since this was last read.",
                values = { [0] = "read before since power-on", [1] = "first read since power-on" },
            },
            {
                name = "open_wire_detection",
                area = "coil",
                address = 275,
                count = 1,
                access = "R/W",
                type = "bool",
                minimum = 0,
                maximum = 1,
                meaning = "Detection of broken thermocouple wires.",
                values = { [0] = "disabled", [1] = "enabled" },
            },
        },
    },
}

local ERRATA = {
    E01 = {
        what = "The syntax line of the section names the command ~AAEE.",
        reading = "~AAEO, with the letters E and O.",
    },
    E02 = {
        what = "The syntax line of the section names the command ~AAEEN.",
        reading = "~AAEON, with the letters E and O.",
    },
    E03 = { what = "The syntax line of the section names the command @AAPN.", reading = "@AASN." },
    E04 = {
        what = "The summary table gives the response of $AA2 an NN field that the section does not have.",
        reading = "!AATTCCFF.",
    },
    E05 = {
        what = "The summary table writes ETT for the host watchdog where the sections write EVV.",
        reading = "EVV; the TT of the table has nothing to do with a type code.",
    },
    E06 = {
        what = "The summary table calls the text in the response of $AAM (Data), the section calls it (Name).",
        reading = "(Name), of variable length.",
    },
    E07 = {
        what = "The same string $AA0Ci is a span calibration on the M-7017mC-16 and a zero calibration on the 7019 series.",
        reading = "The model decides which of the two it is; the bytes cannot.",
    },
    E08 = {
        what = "The same string $AAA reads the inputs in hex on the 7017 series and the CJC update setting on the 7019 series.",
        reading = "The model decides; on the 7018 series it is no command at all.",
    },
    E09 = {
        what = "The digits are swapped between the commands: 0 is span and 1 is zero for a whole module and for a channel of the M-7017mC-16, but 0 is zero and 1 is span for a channel of the 7019 series.",
        reading = "As printed, each in its place.",
    },
    E10 = {
        what = "~AAEO and ~AAEON (letter O) look like ~AAE0 (digit 0), which disables calibration.",
        reading = "Characters are compared exactly: 4F is not 30. V of ~AAEV is 0 or 1 only.",
    },
    E11 = {
        what = "The syntax lines have room for two or four mask digits; the six digits of a single-ended 7017Z appear only in field text and notes. Twenty channels fill five digits.",
        reading = "Six digits 000000 to 0FFFFF; a bit above channel 19 is refused.",
    },
    E12 = {
        what = "The M-7018-16 has 16 channels but is not among the models with a four-digit mask, and its Modbus mask is printed with the range of eight channels.",
        reading = "Four digits, 0000 to FFFF.",
    },
    E13 = {
        what = "The diagnostics of $AAB are two digits, with no wider form, though the M-7019Z has ten channels.",
        reading = "Four digits on the M-7019Z.",
    },
    E14 = {
        what = "The example explains the answer !0101 as a fault of channel 1.",
        reading = "Bit 0 is channel 0: !0101 is a fault of channel 0, !0102 would be channel 1.",
    },
    E15 = {
        what = "In the second example answer the first field is printed with six characters, +25.56.",
        reading = "+025.56, as in the first answer: >010+025.56+002.34+015.79+022.66+008.53+021.43+007.06+022.88.",
    },
    E16 = {
        what = "AA of the response is described as the module's address; the address is just being changed.",
        reading = "A valid response carries the new address. An invalid one carries the old address, since nothing has changed.",
    },
    E17 = {
        what = "The examples that need INIT mode address module 01, but a module powered on in INIT mode has address 00.",
        reading = "The switch position when the command arrives is the permission; the position at power-on is what moves the address to 00. So both 01 (switched while running) and 00 (powered on so) are possible.",
    },
    E18 = {
        what = "$002 is said to tell a forgotten address, but the response of $AA2 has no field for it.",
        reading = "In INIT mode AA of the response is the stored address.",
    },
    E19 = {
        what = "The example of checksum arithmetic, !01200600, has type code 20, which none of these models has.",
        reading = "An example of arithmetic only.",
    },
    E20 = {
        what = "Baud rate and checksum change at the next power-on by one note, after the response by another.",
        reading = "With the INIT switch: at the next power-on. Through soft INIT (M-7017mC-16 and 7019 series): right after the response.",
    },
    E21 = {
        what = "N is one digit; nothing is said of channels 10 to 15 of a 16-channel model, nor whether a single-ended 7017Z still takes one digit.",
        reading = "One digit 0 to F on 16-channel models; exactly two digits, 00 to 13, in single-ended mode.",
    },
    E22 = {
        what = "Syntax and response show one digit for the channel, but a single-ended 7017Z has two.",
        reading = "$AA7CiiRrr, $AA8Cii and !AACiiRrr there.",
    },
    E23 = { what = "The valid response is printed with a blank behind the address.", reading = "No blank." },
    E24 = {
        what = "The general form of a response always has the address; the responses that begin with > are printed without.",
        reading = "No address behind >, except in the response of $AA4.",
    },
    E25 = {
        what = "Disabled channels are blanks on the 7019 series; nothing is said of the other series and $AAA, nor how many blanks.",
        reading = "Blanks of the full width: 7 in engineering and % format, 4 in hex. On the 7017 and 7018 series a decoder accepts them, and no module is expected to send them: the model has 0 there, or the lower end of a type that begins above it.",
    },
    E26 = {
        what = "#** is said to act on every module, but is a command of the 7019 series.",
        reading = "The other series ignore it without a reply.",
    },
    E27 = {
        what = "No response for wrong syntax stands beside ?AA for an invalid command, with no border between them.",
        reading = "Unknown letter, wrong length, wrong checksum, lower case or another address: silence. Well-formed but not allowed: ?AA.",
    },
    E28 = {
        what = "Commands that set something describe AA as the address to be read.",
        reading = "The address of the module to be set.",
    },
    E29 = {
        what = "The CJC temperature read by DCON has the CJC offset in it on the 7018 series and not on the 7019 series; of Modbus nothing is said.",
        reading = "The same holds for Modbus.",
    },
    E30 = {
        what = "Only ~AA1 is said to clear the time-out status; the Modbus maps have a coil (00270) that clears it too, and one (00260) that lets output commands clear it.",
        reading = "~AA1 or coil 00270. Coil 00260 has no effect on modules without outputs.",
    },
    E31 = {
        what = "After a time-out the examples read status 04, with the enable bit 0.",
        reading = "A time-out disables the host watchdog.",
    },
    E32 = {
        what = "What ~AATnn does with more than 60 seconds, and ~AAI with a time-out of 0, is not said.",
        reading = "~AATnn above 3C is refused. ~AAI is always acknowledged.",
    },
    E33 = {
        what = "How long calibration stays enabled is not said, and the procedure enables it again each round.",
        reading = "Until it is disabled or the power goes; enabling again does no harm.",
    },
    E34 = {
        what = "Series names are used with and without the variations: 2.5 and 2.6 name the series and then add the Z models and the M-7017mC-16.",
        reading = "A series is all its variations of chapter 1. For $AAA in hex on I-7017Z, M-7017Z, M-7017RMS and M-7017mC-16 this is uncertain.",
    },
    E35 = {
        what = "The I-7018BL takes thermocouples only, but the default type of its series is 05, a voltage, and note 1 gives types 00 to 06 to the whole series.",
        reading = "Types 0E to 16 only; the default type is unknown, and that of the model is 0E.",
    },
    E36 = {
        what = "An M-7017F is named once and nowhere else; I-7019 and M-7019 stand without suffix though only I-7019R, M-7019R and M-7019Z have data.",
        reading = "No M-7017F; I-7019 is the I-7019R.",
    },
    E37 = {
        what = "The tables of types have no column for I-7017FC, I-7017Z, M-7017Z, M-7018-16 and I-7018BL.",
        reading = "I-7017FC as I-7017C. 7017Z: 07, 08 to 0D, 1A. M-7018-16: 00 to 06, 0E to 16. I-7018BL: 0E to 16.",
    },
    E38 = {
        what = "Types 17 and 18 on I-7018R and M-7018R: given by note 2 and by the table, left out by footnote *3 and by 1.3.",
        reading = "Supported.",
    },
    E39 = {
        what = "Type 19: note 3 and the table give it to I-7018R, M-7018R, I-7018Z, M-7018Z and the 7019 series, footnote *4 and 1.3 to the 7019 series only.",
        reading = "As note 3 and the table.",
    },
    E40 = {
        what = "Types 07 and 1A on the M-7019Z: no firmware limit by note 5 and footnote *5, B2.7 by the column that it shares with I-7019R and M-7019R.",
        reading = "No limit.",
    },
    E41 = { what = "One cell of the table of types has a firmware B2,2.", reading = "B2.2." },
    E42 = {
        what = "The M-7017RMS measures RMS voltages from 0 up, but its type codes are those of ranges with two signs; note 5 could be read to give it types 07 and 1A.",
        reading = "Types 08 to 0C, with readings that are never negative; no 07, 0D, 1A.",
    },
    E43 = {
        what = "The lists of models with a fast mode differ.",
        reading = "FF bit 5 and 1.3 decide: I-7017F, I-7017FC, I-7017R, I-7017RC, I-7017R-A5, I-7017Z, M-7017R, M-7017RC, M-7017R-A5, M-7017mC-16, M-7017Z. The Modbus settings follow.",
    },
    E44 = {
        what = "Two places fix Modbus at no parity and one stop bit; CC bits 7:6 and register 40486 choose among four formats.",
        reading = "The bits are real from the firmware listed in 1.11.",
    },
    E45 = {
        what = "Types 07 and 1A have FFFF and 0000 in a row called two's complement.",
        reading = "Unsigned, 0000 to FFFF, for these two types.",
    },
    E46 = {
        what = "In hex the over range word 7FFF and the under range word 8000 are also legal readings.",
        reading = "For thermocouples the special word wins: 7FFF is over range and 8000 under range, with no value. An end of a thermocouple whose word that is, is written so all the same. For voltages and currents they are plain readings.",
    },
    E47 = {
        what = "In hex the under range word of type 07 is 0000, which is also exactly 4 mA.",
        reading = "The special word wins: 0000 is under range. 4 mA is written 0000 all the same, and reads back as under range. Engineering and % format do not have the ambiguity.",
    },
    E48 = {
        what = "Special texts stand among numbers.",
        reading = "+9999.9, -9999.9, +999.99, -999.99 and the Modbus words -32768 and 32767 are compared literally and never scaled.",
    },
    E49 = {
        what = "The I-7018 series up to firmware B1.4 prints +9999 and -0000, five characters, in every format, hex included.",
        reading = "Split a line at its signs, not by width; compare the text -0000 before converting. In hex a line with special readings is split by trying the sign first.",
    },
    E50 = {
        what = "Out-of-range readings are defined for thermocouples and for 4 to 20 mA under range, not for other voltages and currents.",
        reading = "A decoder accepts the special texts for every type. A module is expected to send them, in engineering and % format, for voltages and currents too.",
    },
    E51 = {
        what = "The printed words of negative full scale follow another rounding than the formula of A.5.",
        reading = "Decode exactly by A.5. Encode to the nearest word under A.5, so that word to value to word changes nothing. The printed table is nearest(value x 32767 / max), with -max as 8000. Two printed cells are one count off the first rule: 0F (E6D0) and 15 (E56B). A difference of one count is no fault.",
    },
    E52 = {
        what = "Modbus engineering counts of type 18 are 0.01 degC, of every other thermocouple 0.1 degC.",
        reading = "As printed.",
    },
    E53 = {
        what = "3.5 gives the two ends but no scale.",
        reading = "A register is the engineering field without its point, and without its last digit where the number would otherwise pass 32767.",
    },
    E54 = {
        what = "Type 18 has +050.00 % and 4000 at its upper end.",
        reading = "Percent and hex are relative to the larger absolute value of the two ends, 200 degC here, not to the upper end.",
    },
    E55 = {
        what = "The table of functions has 02, 04 and 70 only; the maps have coils and holding registers, some of them writable, and 3.4.8 and 3.4.9 limit how many registers one write has.",
        reading = "01, 03, 05, 06, 0F and 10 are supported from the firmware of the map on (B3.0 of the M-7017 series and the M-7019R, B3.5 of the M-7018 series), by the usual Modbus rules.",
    },
    E56 = {
        what = "Function 02 is said to be for the M-7019 series; the maps of the M-7017 models have discrete inputs too.",
        reading = "It is there on the M-7017 models with discrete inputs as well, for types 07 and 1A, from the firmware of the map on.",
    },
    E57 = {
        what = "The response is printed with a byte count of 1 and one byte, but the M-7019Z may be asked for ten channels.",
        reading = "The byte count is that of the bits, count / 8 rounded up.",
    },
    E58 = {
        what = "The bits are said to tell open wires in one place, over or under range in another, all three in a third.",
        reading = "A bit is 1 when the channel is enabled and over range, under range or open.",
    },
    E59 = {
        what = "The limits of function 04 stop at channel 7 or 9 and the CJC temperature; the maps have 16 and 20 inputs, temperatures in whole degrees and log records.",
        reading = "The map decides.",
    },
    E60 = {
        what = "The channels of 07 and 08 leave out models on which every channel has a type of its own: M-7017RMS, M-7017mC-16, M-7017R from B3.9, M-7018R from B4.5, and the single-ended M-7017Z.",
        reading = "0 to the last channel on every model whose channels have types of their own; 0 on the others.",
    },
    E61 = {
        what = "The size of the mask of 16-channel models and the order of its bytes are not given.",
        reading = "Two bytes for 9 to 16 channels, three for 20; the high byte first.",
    },
    E62 = {
        what = "The CJC offset of a channel is one byte of 0.1 degC inside a field of two in 2B and 2C, for the M-7018 and M-7019 series alike; the maps of the M-7019 have CJC offsets of 0.01 degC and, apart from them, temperature offsets of 0.1 degC.",
        reading = "The low byte has the offset in two's complement, the high byte is 00. On the M-7019 series 2B and 2C mean the temperature offset.",
    },
    E63 = {
        what = "The exceptions of 2B and 2C name a reserved byte that these requests do not have; those of 2D leave out the one it has.",
        reading = "2B and 2C: a channel byte that means nothing gives exception 03. 2D: a reserved byte that is not zero does.",
    },
    E64 = {
        what = "The result byte is labelled as a type code in the response of 08, as miscellaneous settings in those of 2E and 30.",
        reading = "It is the result: 0 is done, anything else an error.",
    },
    E65 = {
        what = "To switch to DCON, 1.12.1 sets byte 8 of 06 to 1; in 3.3.4 1 is Modbus RTU.",
        reading = "0 is DCON and 1 is Modbus RTU.",
    },
    E66 = {
        what = "Register 40490 of the M-7018-16 is printed with the limits of eight channels.",
        reading = "0000 to FFFF.",
    },
    E67 = {
        what = "Firmware is written both B4.5 and B405.",
        reading = "What follows the first digit is the number after the point: B405 is B4.5, B300 is B3.0.",
    },
    E68 = {
        what = "Open wire detection of the M-7018R: from B4.2 for DCON, from B4.5 for Modbus.",
        reading = "B4.2 for DCON, as printed, though B4.5 is likelier for both.",
    },
    E69 = {
        what = "I-7018BL, I-7018Z, M-7018Z and M-7018-16 have open wire detection, but no DCON command to read or switch it.",
        reading = "No command there. A broken wire shows as the reading, over range.",
    },
    E70 = {
        what = "The M-7018Z has types 07 and 1A, but its map no over or under range bits, which the M-7017 models have for these types.",
        reading = "It has none.",
    },
    E71 = {
        what = "The M-7017Z has 20 readings and type codes in its map, but 10 over or under range bits.",
        reading = "Bits of channels 0 to 9, as printed.",
    },
    E72 = {
        what = "The M-7019R has 8 samples a second by 1.3; a Modbus coil (00274) chooses 8 or 10.",
        reading = "Both rates exist from B3.0; models.json has that of 1.3. The default is not stated, and that of the model is 8 (coil 1).",
    },
    E73 = {
        what = "The year of the clock goes to 2159; seconds since 1970 in 32 bits end in 2106.",
        reading = "The two registers count as an unsigned number, to 2106; later times only by the six registers of the calendar.",
    },
    E74 = {
        what = "The sampling period of the logger has hours 0 to 24 beside minutes and seconds 0 to 59: 24:59:59 is possible, and so is 0:0:0.",
        reading = "The limits are as printed; what a period of nothing does is undefined.",
    },
    E75 = {
        what = "How firmware version and name stand in their registers, and which word comes first in clock, log indices and time stamps, is not said; nor what the byte order coil of the M-7017mC-16 acts on.",
        reading = "Low word first everywhere, but where clock and logger are concerned the coil decides. The name is the number 00701700 (hex) or its like of 3.3.1: 40483 is 1700, 40484 is 0070. The content of the firmware registers is left open; the model has the three bytes of 3.3.7 there, B4.5 as 0B 04 05.",
    },
    E76 = {
        what = "Coil 00270 is for the Modbus RTU protocol only on the M-7017mC-16; the other maps do not say so.",
        reading = "As printed; a coil is reached by Modbus only.",
    },
    E77 = {
        what = "The name has the series only: M-7017R, M-7017Z, M-7017mC-16 and the others cannot be told apart; M-7017RMS and M-7018-16 are not mentioned.",
        reading = "The name is that of the series, for every model.",
    },
    E81 = {
        what = "What TT is on models that do not use it is not said.",
        reading = "Any TT is accepted there; $AA2 reports FF where the channels differ in type.",
    },
    E82 = {
        what = "DCON addresses are 00 to FF, Modbus addresses 1 to 247; nothing is said of a module at 00 or above F7 that is switched to Modbus.",
        reading = "Undefined; nothing tests it.",
    },
    E83 = {
        what = "Which data format the analog registers have when the module comes from the factory is not said, and 3.2 does not say which they have.",
        reading = "Coil 00269 decides; the default is unknown, and that of the model is hexadecimal.",
    },
    E84 = {
        what = "The bits from 10129 on mean currents of type 07 and 1A out of range on the M-7017 models, but any reading out of range on the M-7019 models.",
        reading = "As printed for each model.",
    },
    E85 = {
        what = "The CJC offset of DCON is a sign and an absolute value, so that +0000 and -0000 both exist; that of Modbus is two's complement.",
        reading = "Both DCON texts are zero when read; zero is sent as +0000. Converted between the protocols.",
    },
    E86 = {
        what = "The calibration tables name no inputs for types 07 and 1A, for thermocouples (but type 10 of the 7019 series up to B2.6), for 0A, 0B, 0D of the 7019 series, for M-7017RMS and M-7017mC-16.",
        reading = "Calibration commands are answered on every type; a model of a module changes nothing by them.",
    },
    E87 = {
        what = "Slips without effect: notes of 2.8 numbered from 3 and of 2.7 without points, a lone comma in 2.11, firmware limits in the note but not the field text of 2.16, 2.7 missing among the commands related to 2.31, models missing in a list of 4.2, type 19 spelt three ways.",
        reading = "None of them changes a byte.",
    },
    E88 = {
        what = "FF bit 7 is the filter of every model, but the map of the M-7017mC-16 has no coil for it.",
        reading = "The filter is there in FF and cannot be set by coil.",
    },
    E89 = {
        what = "What a module does with data format 3, reserved bits, undefined type codes or baud rate codes is not said.",
        reading = "It refuses with ?AA.",
    },
    E90 = {
        what = "A request may fail by a result byte that is not 0 or by exception 03; and when a new address takes effect, and which address the response has, is not said.",
        reading = "What is out of its limits gives the exception. The response comes from the old address, and the new one holds right after it.",
    },
    E91 = {
        what = "DCON needs the INIT switch to change protocol or baud rate, Modbus does not.",
        reading = "As printed.",
    },
    E92 = {
        what = "S = 0 (DCON only) cannot occur, since only models with both protocols have the command.",
        reading = "A module sends 1; a decoder accepts 0 and 1.",
    },
    E93 = {
        what = "Forms of variable length can be read only with checksum state, model and connecting mode known.",
        reading = "Strip the checksum by configuration, then match the length by model and mode.",
    },
    E94 = {
        what = "Exceptions are given for 02, 04 and 70 only: none for coils and holding registers, for writing what is read only, reading what is write only, addresses between two rows of a map, or values out of their limits; address 0 is not mentioned.",
        reading = "As 3.1 and 3.2 have them, for every function alike: 02 where start is not in the map for this access; else 03 where any other address is not, be it behind the end, in a gap between two rows, or a row without this access; 03 for values out of their limits. Functions 05, 06, 0F and 10 to address 0 are done by all modules and answered by none.",
    },
    E95 = {
        what = "The default fast mode of I-7017F and I-7017FC is not given as a value of FF.",
        reading = "FF is 20 there and 00 on every other model.",
    },
    E96 = {
        what = "Fast mode is 50 samples a second on the -A5 models, 200 on the M-7017mC-16 and 60 elsewhere; FF says 12 bits for all.",
        reading = "Per model, from 1.3.",
    },
    E97 = {
        what = "What the register of a disabled channel holds is not said.",
        reading = "Undefined; nothing tests it. The model has 0 there, or the lower end of a type that begins above it.",
    },
    E98 = {
        what = "The example readings (+025.12 and so on) do not name a type; only types with two decimals print such fields.",
        reading = "A type with two decimals is set where the examples are replayed.",
    },
    E99 = {
        what = "Start + count beyond the end gives exception 03, where usual Modbus has 02.",
        reading = "As printed: 02 for a start that is not there, 03 for too many or a wrong length. Too many are also those that lie in a gap of the map, or go over one.",
    },
    E100 = {
        what = "A host watchdog enabled with a time-out of 0 is not described.",
        reading = "Undefined; nothing tests it. In the model it never times out.",
    },
    E101 = {
        what = "In INIT mode settings are said to take effect at the next power-on, while 2.1 has address, type, format and filter change at once.",
        reading = "In INIT mode the address stays 00 until the next power-on; outside it the address changes at once.",
    },
    E102 = {
        what = "The alphabet of (Name) is not stated.",
        reading = "Printable ASCII, 20 to 7E, without the leading characters % # $ ~ @ ! > ?. E122 has the rest.",
    },
    E103 = {
        what = "Reloading the calibration is said to take about three seconds from firmware B2.7 on; nothing is said of older firmware.",
        reading = "A host waits three seconds on any firmware.",
    },
    E104 = {
        what = "The channels of 2B and 2C end at 87, or at 89 on two models; the map of the M-7018-16 has a CJC offset for each of 16 channels.",
        reading = "80 to 8F on the M-7018-16.",
    },
    E105 = {
        what = "How the log records of the M-7017mC-16 are counted, and when the first one is taken, is not said.",
        reading = "From 1 on; an index of 0 says that there is none. In continuous mode the first is taken when the logger starts, in period mode at the starting time; the others follow a period apart.",
    },
    E106 = {
        what = "What else than ~** tells the host watchdog that the host is alive is not said, and Modbus has no ~**.",
        reading = "By DCON ~** alone; by Modbus every request to this module, or to all, that is carried out. Setting the watchdog, and power-on, begin the time anew.",
    },
    E107 = {
        what = "~AAI and %AANNTTCCFF are to be sent one after the other; what another command between them does is not said, nor whether the permission holds for more than one %.",
        reading = "It ends with the time-out, or with the next command that is carried out, whichever it is. Refused commands and broadcasts do not end it.",
    },
    E108 = {
        what = "Whether a setting that is changed between #** and $AA4 changes the sampled data is not said.",
        reading = "They stay what was read at #**: types, offsets and channels are those of that moment. The data format is that of the answer.",
    },
    E109 = {
        what = "How many records the data logger has room for is not said, nor what it does when it is full, nor what the registers of records that are not there hold.",
        reading = "1024 records. Full, it stops, and stays so until it may overwrite; then the oldest make room, and the indices go on. Records that are not there are 0.",
    },
    E110 = {
        what = "What clock and data logger of the M-7017mC-16 keep without power, when a running logger follows a change of its settings or its clock, and what 40875 tells outside the times of the period mode, is not said.",
        reading = "Settings, command, records and clock are kept; the clock runs on, from the year 2000 if it was never set. Nothing is recorded without power, and what is recorded after it keeps to the period. A change of settings or clock begins the periods anew. 40875 is 0 outside the times.",
    },
    E111 = {
        what = "What a date that its month does not have means, such as the 31st of February, is not said; the parts of a date can be written one by one.",
        reading = "The last day of that month.",
    },
    E112 = {
        what = "What a host hears when several modules answer at once is not said.",
        reading = "Each bit is 1 where all of them send 1, so that equal answers look like one.",
    },
    E113 = {
        what = "The names and firmware versions that modules come with are not listed.",
        reading = "The name is the model without its first letter and hyphens, in upper case, cut to six characters; the firmware is B4.5, the latest that is named.",
    },
    E114 = {
        what = "Whether the count of host watchdog time-outs in 40492 survives the power, and where it ends, is not said.",
        reading = "It is kept as the status is, and ends at 65535.",
    },
    E115 = {
        what = "Whether the CJC update setting survives the power, and what is read back once an update has been made on 2, is not said.",
        reading = "It is 1 after every power-on, and reads back as it was set.",
    },
    E116 = {
        what = "How a thermocouple reads when its compensation is disabled, shifted or held, or when its wire is open and not looked for, is not given in numbers.",
        reading = "The model is linear: the hot end less the true cold junction, plus the known one and its offsets. An open wire that is not looked for reads as a short circuit, the temperature of the terminals.",
    },
    E117 = {
        what = "What the registers of whole degrees hold when the type is no thermocouple, or the reading is out of range or its channel disabled, is not said, nor how a reading is rounded.",
        reading = "The nearest number of degrees, of two the even one; 0 when the type is not a thermocouple or the channel is disabled; 7FFF and 8000 out of range.",
    },
    E118 = {
        what = "The map of the M-7017Z has 20 inputs and type codes; what those of channels 10 to 19 hold in differential mode is not said.",
        reading = "Undefined; nothing tests it. The model reads what is on the input.",
    },
    E119 = {
        what = "Fast mode has 12 bits; which readings these are is not said.",
        reading = "4096 steps of equal width from the lower end of the range on, so that the last is one step below the upper end. A reading is the nearest step, of two the one with the even number; what is out of range stays so.",
    },
    E120 = {
        what = "What the padding bits are, those of the last byte of coils or discrete inputs that are beyond the count, is not said.",
        reading = "0 when written, by module and host. Read, they are dropped, whatever they are: in a request of function 0F and in the answers to 01 and 02.",
    },
    E121 = {
        what = "How far beyond its range a module still writes numbers is not said, nor whether every firmware has the decimals of the table: older manuals print others for some types.",
        reading = "A number in a DCON field has the decimals of the table for its type, and lies at most a tenth of max beyond the range, in every data format. Any other number is a sign of a wrong type, model or data format: a reader rejects it, unless it is asked to be lenient. A Modbus register is not held against this: it reads as the number that it is.",
    },
    E122 = {
        what = "A name to be set has at most six characters; how long a name and a version are in a response is not said, nor that they differ from other answers. $AAM, $AAF, $AA2 and $AA6 are all answered !AA and some text.",
        reading = "A name has 1 to 6 characters. A version is a letter, a digit, a point and one or two digits. A name is not the text of another response to the same address: 2, 4 or 6 hexadecimal digits, 3 that begin with 0 or 1, one of 0 1 2, a sign and four hexadecimal digits, CiRrr, CiiRrr, or a version. What begins with the number of a series, 7017, 7018 or 7019, is a name all the same. A module refuses ~AAO with any other name.",
    },
    E130 = {
        what = "The vendor's quick start of the M-7019R gives 40353 to 40360 as one byte of 0.1 degC, 3.4.8 as -4096 to 4096 in 0.01 degC.",
        reading = "As 3.4.8 has it.",
    },
    E131 = {
        what = "What the registers of the data logger hold before they are first written is not said.",
        reading = "The read index is 1, the period 0:0:0, the starting time the beginning of 2000 and the ending time the end of 2159; the logger is stopped, and does not overwrite.",
    },
    E132 = {
        what = "1.9 does not list the factory setting of open wire detection, of coil 00260 and of the response delay.",
        reading = "Open wire detection is enabled on every model that has it, coil 00260 is 0, the response delay is 0.",
    },
    E133 = {
        what = "What a voltage or current input reads that nothing is connected to, or what an input reads whose signal is not what its type measures, is not said.",
        reading = "Nothing connected reads as 0, which is under range with type 07. Voltages and currents stand for each other across 125 ohms. A thermocouple is 0 at an input of another type; a voltage at an input of a thermocouple type is over or under range by its sign, and a voltage of 0 V reads as a short circuit: the temperature of the terminals.",
    },
    E134 = {
        what = "Whether the CJC offsets apply while CJC is disabled, and whether readings include the offsets of the channels, is not said.",
        reading = "Readings of thermocouples include every offset, also those of the channels. While CJC is disabled, they include no offset except the temperature offset of the 7019 series. The CJC temperature that a module reports is the same with CJC enabled and disabled.",
    },
    E135 = {
        what = "Whether the ending time of the data logger belongs to its period mode is not said.",
        reading = "It does, as the starting time does: a record that is due at the ending time is taken, and 40875 is 1 then.",
    },
    E136 = {
        what = "What writing 0 to coil 00270 does, or another number than 0 to 40492, is not said.",
        reading = "Exception 03; nothing changes.",
    },
    E137 = {
        what = "What a voltage or current out of its range reads in hex, where no special word stands for it, is not said.",
        reading = "The word of the nearer end of the range: 7FFF or 8000, FFFF or 0000.",
    },
    E138 = {
        what = "Whether a time still runs at the very moment at which it is full is not said.",
        reading = "It does not: at that moment the host watchdog has timed out, and soft INIT is over.",
    },
    E139 = {
        what = "Whether one register of a number that takes two can be read or written alone, as of the clock in seconds or of 40873, and what becomes of the other, is not said.",
        reading = "It can. What is read is that half of the number at that moment. A write keeps the other half as it is at that moment. Which half a register is depends on coil 00283 (E75).",
    },
    E140 = {
        what = "How a reading that lies halfway between two numbers of its format is rounded is not said, nor the sign of a negative reading that is rounded to zero.",
        reading = "To the even one: the text whose last digit is even, the even word or register. A zero in text always has a plus sign.",
    },
}

-- What is known of modules: the preferences, read into profiles.

local function firmware_number(text)
    local letter, major, minor = text:match("^(%a)(%d+)%.(%d+)$")
    return letter and (letter:upper():byte() * 1000 + tonumber(major)) * 1000 + tonumber(minor)
end

-- Whether a firmware is at least another one; nil is the newest, and "always", like false, any.
local function since(profile, first)
    if not first or first == "always" or not profile.firmware then
        return true
    end
    return profile.firmware >= firmware_number(first)
end

-- Whether a module has what these models have; nil is all models. A module of unknown model has everything.
local function has(models, profile)
    if not models or not profile.model then
        return true
    end
    local first = models[profile.model.name]
    return first ~= nil and since(profile, first)
end

-- How many channels a module has, or nil.
local function channels_of(profile)
    local model = profile.model
    if not model then
        return nil
    end
    if profile.single_ended and model.single_ended_by_command then
        return model.single_ended_channels
    end
    return model.channels
end

-- Whether a module sends the lines of the old I-7018 firmware.
local function is_legacy(profile)
    local model = profile.model
    return model and model.series == "7018" and model.name:sub(1, 2) == "I-" and profile.firmware
        and profile.firmware <= firmware_number(LEGACY_UNTIL) or false
end

-- The type of a channel, or nil.
local function type_of(profile, channel)
    local codes = profile.types
    local code = codes and (#codes == 1 and codes[1] or codes[channel + 1])
    if not codes and profile.model then
        code = profile.model.default_type
    end
    return code and TYPES[code]
end

local TYPE_NAMES = {}
for code, row in pairs(TYPES) do
    TYPE_NAMES[row.key:upper()] = code
    TYPE_NAMES[string.format("%02X", code)] = code
end

local function read_types(text)
    local codes = {}
    for name in text:gmatch("[^/,%s]+") do
        codes[#codes + 1] = TYPE_NAMES[name:upper()]
            or error(name .. " is not a type; examples: K, V_10, MA_4_20, 0F", 0)
    end
    return #codes > 0 and codes or nil
end

local function read_model(text)
    for _, model in ipairs(MODELS) do
        if model.name:upper() == text:upper() then
            return model
        end
    end
    error(text .. " is not a model; example: M-7019R", 0)
end

local function one_of(allowed)
    return function(text)
        local value = allowed[text]
        if value == nil then
            error(text .. " is not a value of this setting", 0)
        end
        return value
    end
end

local TRUTHS = { ["true"] = true, ["yes"] = true, ["1"] = true, ["false"] = false, ["no"] = false, ["0"] = false }
local SETTINGS_OF_A_MODULE = {
    type = { "types", read_types },
    format = { "format", one_of({ engineering = "engineering", percent = "percent", hex = "hex" }) },
    modbus_format = { "modbus_format", one_of({ engineering = "engineering", hex = "hex" }) },
    checksum = { "checksum", one_of(TRUTHS) },
    single_ended = { "single_ended", one_of(TRUTHS) },
}

local function read_firmware(text)
    return firmware_number(text) or error(text .. " is not a firmware; example: B3.7", 0)
end

local preferences = { modules = {}, errata = true }

-- Read [INTERFACE:][ADDRESS=]MODEL[@FIRMWARE][,name=value...].
local function read_module(text, general)
    local profile = {}
    for name, value in pairs(general) do
        profile[name] = value
    end
    profile.types, profile.firmware = nil, nil
    local interface, rest = text:match("^(%d+):(.*)$")
    local address, described = (rest or text):match("^(%w+)=(.*)$")
    if address then
        address = tonumber(address) or error(address .. " is not an address; examples: 26, 0x1A", 0)
    end
    described = described or rest or text
    local head, settings = described:match("^([^,]*),?(.*)$")
    local model, firmware = head:match("^([^@]*)@(.*)$")
    profile.model = read_model(model or head)
    profile.firmware = firmware and read_firmware(firmware)
    for assignment in settings:gmatch("[^,]+") do
        local name, value = assignment:match("^(.-)=(.*)$")
        local setting = SETTINGS_OF_A_MODULE[name or ""]
            or error(assignment .. " is not a setting of a module; examples: type=K, format=hex", 0)
        profile[setting[1]] = setting[2](value)
    end
    return (interface or "*") .. ":" .. (address and string.format("%d", address) or "*"), profile
end

-- Run a reader; keep the message of its error.
local function guarded(read, ...)
    local good, found, more = pcall(read, ...)
    if good then
        return found, more
    end
    preferences.fault = tostring(found)
end

-- The profile of a module.
local function profile_of(interface, address)
    local modules = preferences.modules
    address = address and string.format("%d", address) or "*"
    return modules[interface .. ":" .. address] or modules[interface .. ":*"] or modules["*:" .. address]
        or modules["*:*"]
end

-- A profile with what a line has shown of the module, where nothing else is said.
local function with_learned(profile, learned)
    if not learned or profile.format and profile.types then
        return profile
    end
    local known = {}
    for name, value in pairs(profile) do
        known[name] = value
    end
    known.format = profile.format or learned.format
    known.types = profile.types or learned.types
    return known
end

local FORMATS = { [0] = "engineering", [1] = "percent", [2] = "hex" }

local function read_preferences(prefs)
    preferences.fault = nil
    preferences.errata = prefs.errata
    local general = {
        model = prefs.model > 0 and MODELS[prefs.model] or nil,
        firmware = prefs.firmware ~= "" and guarded(read_firmware, prefs.firmware) or nil,
        types = guarded(read_types, prefs.types),
        format = FORMATS[prefs.format - 1],
        modbus_format = FORMATS[prefs.modbus_format],
        single_ended = prefs.single_ended,
    }
    if prefs.checksum > 0 then
        general.checksum = prefs.checksum == 2
    end
    preferences.modules = { ["*:*"] = general }
    for text in prefs.modules:gmatch("[^;%s]+") do
        local key, profile = guarded(read_module, text, general)
        if key then
            preferences.modules[key] = profile
        end
    end
end

-- What fields mean: readings, settings in words, and which numbers a module takes.

-- The special reading that a text (or a register) is, or nil.
local function special(value, format, code, legacy)
    for _, row in ipairs(SENTINELS) do
        if row.format == format and row.value == value and (not row.types or row.types[code]) then
            local other = row.legacy and not legacy or row.not_legacy and legacy
            if not other then
                return row.status
            end
        end
    end
end

local function signed(word)
    return word >= 0x8000 and word - 0x10000 or word
end

local function value_of_word(word, kind)
    if not kind.hex_signed then
        return kind.minimum + word * (kind.maximum - kind.minimum) / 65535
    end
    local number = signed(word)
    return number * kind.max / (number >= 0 and 32767 or 32768)
end

-- The special texts of either format are special in both (E48).
local OTHER_TEXT_FORMAT = { engineering = "percent", percent = "engineering" }

-- Read the text of a channel: its value, unit and status, or a note instead. The value of an unknown type is what the
-- text says, without unit.
local function reading_of_text(text, format, kind, legacy)
    local blanks = text:match("^ +$") and "disabled"
    local other = OTHER_TEXT_FORMAT[format]
    local status = blanks or kind and (special(text, format, kind.code, legacy)
        or other and special(text, other, kind.code, legacy))
    if status then
        return nil, kind and kind.unit, status
    end
    local number = tonumber((text:gsub("^%+", "")))
    if not kind then
        return format ~= "hex" and number or nil, format == "percent" and "%" or nil, "ok"
    elseif format == "hex" then
        number = value_of_word(tonumber(text, 16), kind)
    elseif format == "percent" then
        local span = kind.hex_signed and kind.max or kind.maximum - kind.minimum
        number = (kind.hex_signed and 0 or kind.minimum) + number * span / 100
    elseif #text:match("%.?(%d*)$") ~= kind.engineering_decimals then
        return number, nil, "ok", "the decimals are not those of " .. kind.name
    end
    local margin = kind.max / 10 * (1 + 1e-12)
    if number < kind.minimum - margin or number > kind.maximum + margin then
        return number, nil, "ok", "out of the range of " .. kind.name
    end
    return number, kind.unit, "ok"
end

-- Read a register of an analog input.
local function reading_of_register(word, format, kind)
    if not kind then
        return nil, nil, "ok"
    end
    local number = signed(word)
    local status = special(format == "hex" and word or number, "modbus_" .. format, kind.code, false)
    if status then
        return nil, kind.unit, status
    end
    if format == "hex" then
        return value_of_word(word, kind), kind.unit, "ok"
    end
    return number / kind.modbus_counts_per_unit, kind.unit, "ok"
end

local function bits(byte, low, count)
    return math.floor(byte / 2 ^ low) % 2 ^ count
end

-- A setting's row holds for a module: by its firmware, and by what the model needs.
local function setting_holds(row, profile)
    local model = profile.model
    if not model then
        return true
    end
    if row.needs and not model[row.needs] then
        return false
    end
    local first = row.firmware and (row.firmware[model.name] or row.firmware[model.name:sub(3)]
        or row.firmware[model.series])
    return since(profile, first)
end

-- The settings in a byte, in words; and whether a module has them all.
local function settings_in(byte, letters, profile)
    local words, good, known = {}, true, 0
    for _, row in ipairs(BIT_SETTINGS) do
        local code = row.letters == letters and bits(byte, row.low_bit, row.bits)
        if code and not row.code then
            good = good and code == 0
        elseif code and code == row.code then
            words[#words + 1] = row.name
            known = known + 1
            good = good and setting_holds(row, profile)
        end
    end
    return table.concat(words, ", "), good and known == BIT_GROUPS[letters]
end

local function channels_in(mask)
    local found = {}
    for channel = 0, 23 do
        if bits(mask, channel, 1) == 1 then
            found[#found + 1] = tostring(channel)
        end
    end
    return #found == 0 and "no channel" or "channels " .. table.concat(found, ", ")
end

local LETTERS = { line_settings = "CC", report_settings = "FF" }

-- A value in words, or nil if the number says it all.
local function in_words(field, value, values)
    if LETTERS[field.name] then
        return (settings_in(value, LETTERS[field.name], {}))
    elseif field.name == "mask" then
        return channels_in(value)
    elseif field.name == "type_code" then
        return TYPES[value] and TYPES[value].name or value == 0xFF and "the channels differ" or "undefined"
    elseif CODE_NAMES[field.name] then
        return CODE_NAMES[field.name][value]
    elseif field.legal == "offset_channels" then
        return value == 0 and "module" or value >= 0x80 and string.format("channel %d", value - 0x80) or nil
    elseif field.unit and type(value) == "number" then
        local of_channel = (values.channel or 0) >= 0x80
        local scales = field.scale or { 1 }
        local scale = of_channel and scales[2] or scales[1]
        return string.format("%.10g %s", value * scale, field.unit)
    end
end

-- Whether a name could be the text of another response.
local function is_other_answer(name)
    if name:match("^[+-]%x%x%x%x$") and not name:match("%l") or name:match("^[012]$")
        or name:match("^%u%d%.%d%d?$") or name:match("^C[%dA-F][%dA-F]?R[%dA-F][%dA-F]$") then
        return true
    end
    if not name:match("^[%dA-F]+$") then
        return false
    end
    local is_series = #name >= 4 and SERIES[name:sub(1, 4)]
    return #name == 2 or (#name == 4 or #name == 6) and not is_series or #name == 3 and name:match("^[01]") ~= nil
end

local function is_type(code, profile)
    local model = profile.model
    if not model then
        return TYPES[code] ~= nil
    end
    local first = model.types[code]
    return first ~= nil and since(profile, first)
end

local RULES = {
    types = is_type,
    types_or_mixed = function(code, profile)
        local mixed = profile.model and profile.model.mixed_types
        return mixed == "ignored" or is_type(code, profile)
            or code == 0xFF and (not profile.model or mixed and since(profile, mixed)) or false
    end,
    channels = function(channel, profile)
        return channel < (channels_of(profile) or 20)
    end,
    type_channels = function(channel, profile)
        local each = not profile.model or profile.model.individually_configurable
        return channel < (each and since(profile, each) and (channels_of(profile) or 20) or 1)
    end,
    offset_channels = function(channel, profile)
        return channel == 0 or channel >= 0x80 and channel - 0x80 < (channels_of(profile) or 20)
    end,
    offsets = function(offset, _, values, field)
        if (values.channel or 0) >= 0x80 then
            return offset >= 0 and offset <= 255
        end
        return offset >= field.minimum and offset <= field.maximum
    end,
    channel_bits = function(mask, profile)
        return mask < 2 ^ (channels_of(profile) or 20)
    end,
}

-- Whether a module takes a number, or sends it.
local function is_legal(field, value, values, profile)
    if field.kind == "name" then
        return not is_other_answer(value)
    elseif type(value) ~= "number" then
        return true
    elseif LETTERS[field.name] then
        local _, good = settings_in(value, LETTERS[field.name], profile)
        return good
    elseif field.name == "settings" then
        local _, good = settings_in(value, "FF", profile)
        return good and field.legal[value] ~= nil
    elseif type(field.legal) == "string" then
        return RULES[field.legal](value, profile, values, field)
    elseif field.legal then
        return field.legal[value] ~= nil
    end
    return (not field.minimum or value >= field.minimum) and (not field.maximum or value <= field.maximum)
end

-- DCON: bodies <-> fields. A position is that of a character in the body, from 1 on.

local LEADING = "[%%#%$~@!>%?]"
local COMMANDS_BEGIN, RESPONSES_BEGIN = "^[%%#%$~@]", "^[!>%?]"

local function checksum_of(body)
    local sum = 0
    for at = 1, #body do
        sum = sum + body:byte(at)
    end
    return string.format("%02X", sum % 256)
end

-- The fields of a line; those of the old I-7018 firmware have several widths.
local function cut_line(text, format, legacy)
    local fields, at = {}, 1
    local width = format == "hex" and 4 or 7
    while at <= #text do
        local size = width
        if legacy and format == "hex" then
            size = text:match("^[+-]", at) and 5 or 4
        elseif legacy and text:sub(at, at) ~= " " then
            size = (text:find("[+%- ]", at + 1) or #text + 1) - at
        end
        fields[#fields + 1] = text:sub(at, at + size - 1)
        at = at + size
    end
    return fields
end

local SHAPES = {
    engineering = function(text)
        return #text == 7 and text:match("^[+-]%d+%.%d+$") ~= nil and text:find(".", 1, true) <= 6
    end,
    percent = function(text)
        return (text:match("^[+-]%d%d%d%.%d%d$") or text:match("^[+-]9999%.9$")) ~= nil
    end,
    hex = function(text)
        return text:match("^[%dA-F][%dA-F][%dA-F][%dA-F]$") ~= nil
    end,
}
local function has_shape(text, format, legacy)
    return SHAPES[format](text) or text == (format == "hex" and "    " or "       ")
        or legacy and (text == "+9999" or text == "-0000")
end

local ALLOWED = "^[ -~]$"

-- The fault of a character that may not stand in a name or a version, and its place.
local function bad_character(text)
    for at = 1, #text do
        local character = text:sub(at, at)
        if not character:match(ALLOWED) or character:match(LEADING) then
            return "character", at
        end
    end
end

local function read_digits(text)
    local bad = text:find("[^%dA-F]")
    if bad then
        return nil, "character", bad
    end
    return tonumber(text, 16)
end

local function read_code(text, part)
    local number = text:match("^%d$") and tonumber(text)
    if not number or number < part.minimum or number > part.maximum then
        return nil, "value", 1
    end
    return number
end

-- The format of readings: the one that is known, or else the one that a text looks like.
local function format_of(text, part, profile)
    if not part.digits_by then
        return "hex"
    end
    return profile.format or text:match("[^%dA-F ]") and "engineering" or "hex"
end

local function read_readings(text, part, profile)
    local format = format_of(text, part, profile)
    local legacy = is_legacy(profile)
    local fields = cut_line(text, format, legacy)
    local count = part.kind == "reading" and 1 or channels_of(profile)
    if count and #fields ~= count then
        return nil, "length"
    end
    for _, field in ipairs(fields) do
        if not has_shape(field, format, legacy) then
            return nil, format == "hex" and "character" or "number", 1
        end
    end
    return fields
end

local function read_text(text, is_valid)
    local fault, at = bad_character(text)
    if fault then
        return nil, fault, at
    elseif not is_valid then
        return nil, "value", 1
    end
    return text
end

-- How the text of a part becomes a value; or nil, a fault and its place in the text.
local READERS = {
    hex = read_digits,
    code = read_code,
    bool = function(text, part)
        local number, fault, at = read_code(text, part)
        if fault then
            return nil, fault, at
        end
        return number == 1
    end,
    signed_hex = function(text)
        if not text:match("^[+-]") then
            return nil, "number", 1
        end
        local number, fault, at = read_digits(text:sub(2))
        if fault then
            return nil, fault, at + 1
        end
        return text:sub(1, 1) == "-" and -number or number
    end,
    decimal = function(text)
        if not text:match("^[+-]%d%d%d%d%.%d$") then
            return nil, "number", 1
        end
        return tonumber((text:gsub("^%+", "")))
    end,
    name = function(text, _, _, is_response)
        return read_text(text, not (is_response and is_other_answer(text)))
    end,
    version = function(text)
        return read_text(text, text:match("^%u%d%.%d%d?$"))
    end,
    reading = read_readings,
    readings = read_readings,
}

-- The widths that a part may have, as a function of a width.
local function width_fits(part, profile, text)
    local by = part.digits_by
    local model = profile.model
    if part.kind == "readings" or part.kind == "reading" then
        local digits = format_of(text, part, profile) == "hex" and 4 or 7
        local count = part.kind == "reading" and 1 or channels_of(profile)
        if is_legacy(profile) then
            return function()
                return true
            end
        end
        return function(width)
            if count then
                return width == digits * count
            end
            return width > 0 and width % digits == 0
        end
    end
    local only
    if by == "mask_digits" and model then
        only = profile.single_ended and model.mask_digits_single_ended or model.mask_digits
    elseif by == "channel_digits" and model then
        only = profile.single_ended and 2 or 1
    end
    return function(width)
        if only then
            return width == only
        end
        for _, digits in ipairs(part.digits) do
            if width == digits then
                return true
            end
        end
        return false
    end
end

-- Compare a body with the parts of a syntax: the values by name and the places by name; or nil, a fault and its place.
local function fit(parts, body, profile, is_response)
    local fixed, open = 0, nil
    for _, part in ipairs(parts) do
        if part.width then
            fixed = fixed + part.width
        else
            open = part
        end
    end
    local width = #body - fixed
    local text = open and body:sub(open.offset + 1) or ""
    if open and not (width >= 0 and width_fits(open, profile, text)(width)) or not open and width ~= 0 then
        return nil, "length"
    end
    local values, places, at = {}, {}, 1
    for _, part in ipairs(parts) do
        local size = part.width or width
        local text = body:sub(at, at + size - 1)
        if part.literal then
            for offset = 1, size do
                if text:sub(offset, offset) ~= part.literal:sub(offset, offset) then
                    return nil, "character", at + offset - 1
                end
            end
        else
            local value, fault, place = READERS[part.kind](text, part, profile, is_response)
            if fault then
                return nil, fault, place and at + place - 1
            end
            values[part.name], places[part.name] = value, { at, size }
        end
        at = at + size
    end
    return values, places
end

local function candidates_of(body)
    local leading, fourth = body:sub(1, 1), body:sub(4, 4)
    local by_letter = leading:match("[%$~@]")
    local found = {}
    for _, command in ipairs(DCON_COMMANDS) do
        local same = command.syntax:sub(1, 1) == leading
        if same and by_letter then
            if #body <= 3 then
                same = body:sub(1, 2) == "~*" and command.syntax == "~**"
            else
                same = command.syntax:sub(4, 4) == fourth
            end
        end
        if same then
            found[#found + 1] = command
        end
    end
    return found
end

-- Which command a body is: the command, its values and places, and another command that it may be on another model;
-- or nil, a fault, and the command that the model does not have.
local function command_of(body, profile)
    local candidates = candidates_of(body)
    if #candidates == 0 then
        return nil, #body <= 3 and body:match("^[%$~@]") and "length" or "command"
    end
    local found, foreign
    local worst, worst_at, worst_own = "length", 0, false
    local any_own = false
    for _, command in ipairs(candidates) do
        local own = has(command.models, profile)
        any_own = any_own or own
        local values, places, at = fit(command.parts, body, profile, false)
        if values and own and found then
            found[4] = command
        elseif values and own then
            found = { command, values, places }
        elseif values then
            foreign = command
        elseif places ~= "length" and (own and not worst_own or own == worst_own and at > worst_at) then
            worst, worst_at, worst_own = places, at, own
        end
    end
    if found then
        return found[1], found[2], found[3], found[4]
    elseif foreign then
        return nil, "unsupported", foreign
    elseif any_own and not worst_own then
        worst = "length"
    end
    return nil, worst
end

local REFUSED = { name = "Refused", parts = REFUSED_PARTS }

-- What a response to a command is: its message, values and places; or nil and a fault.
local function response_of(body, request, profile)
    local command = request.command
    local leading = body:sub(1, 1)
    local message = { name = command.response, parts = command.response_parts }
    if leading == "?" then
        message = REFUSED
    elseif leading ~= command.response_syntax:sub(1, 1) then
        return nil, "leading"
    end
    local values, places = fit(message.parts, body, profile, true)
    if not values then
        return nil, places
    end
    local expected = request.values.address
    if message ~= REFUSED and command.name == "SetConfiguration" then
        expected = request.values.new_address
    end
    local any = command.name == "ReadConfiguration" and expected == 0 and message ~= REFUSED
    if values.address and values.address ~= expected and not any then
        return nil, "address"
    end
    if values.channel and values.channel ~= request.values.channel then
        return nil, "value"
    end
    return message, values, places
end

-- The message in a frame: a table with message, values and places, or with a fault; and with the checksum, if any.
local function message_of(body, with_checksum, decode)
    local text, sent = body, nil
    if with_checksum then
        if #body < 3 then
            return { fault = "length" }
        end
        text, sent = body:sub(1, -3), body:sub(-2)
    end
    local right = sent and checksum_of(text)
    local found = { checksum = sent, right = right }
    if sent ~= right then
        found.fault = "checksum"
    end
    local message, values, places, other = decode(text)
    if message then
        found.message, found.values, found.places, found.other = message, values, places, other
    else
        found.fault, found.foreign = found.fault or values, places
    end
    return found
end

-- Read a body with the checksum setting of a module; nil decides by what fits.
local function read_body(body, with_checksum, decode)
    if with_checksum ~= nil then
        return message_of(body, with_checksum, decode)
    end
    local with = message_of(body, true, decode)
    if with.message and not with.fault then
        return with
    end
    local without = message_of(body, false, decode)
    return with.message and not without.message and with or without
end

-- The fault of a frame before its body is read, or nil.
local function frame_fault(frame, begin)
    if #frame == 0 or #frame > 256 then
        return "length"
    elseif frame:find("\r", 1, true) ~= #frame then
        return "terminator"
    elseif frame:sub(1, -2):find("[^ -~]") then
        return "character"
    elseif not frame:match(begin) then
        return "leading"
    end
end

-- What both protocols put into the tree.

local SENT, RECEIVED = 0, 1
local interface_field = Field.new("frame.interface_id")

local function interface_of()
    local found = interface_field()
    return found and tostring(found.value) or "0"
end

-- The line that a packet was on: an interface, or a connection.
local function line_of(pinfo)
    if pinfo.src_port == 0 and pinfo.dst_port == 0 then
        return interface_of()
    end
    local source = tostring(pinfo.src) .. " " .. pinfo.src_port
    local destination = tostring(pinfo.dst) .. " " .. pinfo.dst_port
    return source < destination and source .. " " .. destination or destination .. " " .. source
end

local function title(name)
    return (name:sub(1, 1):upper() .. name:sub(2):gsub("_", " "))
end

local BYTE = ProtoField.uint8
local IN_HEX = {
    address = BYTE, new_address = BYTE, type_code = BYTE, line_settings = BYTE, report_settings = BYTE, status = BYTE,
    settings = BYTE, mask = ProtoField.uint24,
}
local MAKERS = {
    bool = ProtoField.bool, coil = ProtoField.bool, decimal = ProtoField.double, name = ProtoField.string,
    version = ProtoField.string, digits = ProtoField.string, signed_hex = ProtoField.int32, signed = ProtoField.int32,
}
local LISTS = { reading = true, readings = true, bits = true, words = true }

local function of_group(prefix, fields, experts)
    local made = { fields = {}, experts = {} }
    for name, field in pairs(fields) do
        made.fields[name] = field
    end
    for name, row in pairs(experts) do
        local kind, level = expert.group[row[3]], expert.severity[row[4]]
        made.experts[name] = ProtoExpert.new(prefix .. ".expert." .. row[1], row[2], kind, level)
    end
    return made
end

local EXPERTS = {
    checksum = { "checksum", "Wrong checksum", "CHECKSUM", "ERROR" },
    refused = { "refused", "The module refused the command", "RESPONSE_CODE", "WARN" },
    out_of_range = { "out_of_range", "A module does not take this value", "PROTOCOL", "WARN" },
    fault = { "fault", "Not a valid frame", "MALFORMED", "ERROR" },
    cut_off = { "cut_off", "The capture does not have the whole frame", "UNDECODED", "WARN" },
    no_request = { "no_request", "No request before this response", "SEQUENCE", "NOTE" },
    ambiguous = { "ambiguous", "It depends on the model what this is", "UNDECODED", "NOTE" },
    no_reading = { "not_of_type", "Not a reading of this type", "PROTOCOL", "WARN" },
    range_status = { "range_status", "Over or under range", "RESPONSE_CODE", "NOTE" },
    access = { "access", "The model does not have this, or not for this access", "PROTOCOL", "WARN" },
    erratum = { "erratum", "The manual is contradictory or silent", "ASSUMPTION", "CHAT" },
    preference = { "preference", "A preference is invalid", "UNDECODED", "ERROR" },
}

-- The fields that both protocols have, and those of messages.
local function group(prefix, messages)
    local fields = {
        message = ProtoField.string(prefix .. ".message", "Message"),
        section = ProtoField.string(prefix .. ".section", "Manual"),
        fault = ProtoField.string(prefix .. ".fault", "Fault"),
        response_to = ProtoField.framenum(prefix .. ".response_to", "Response to", base.NONE, frametype.REQUEST),
        response_in = ProtoField.framenum(prefix .. ".response_in", "Response in", base.NONE, frametype.RESPONSE),
        time = ProtoField.double(prefix .. ".time", "Seconds since the request"),
        erratum = ProtoField.string(prefix .. ".errata", "Erratum"),
        reading = ProtoField.string(prefix .. ".reading", "Reading"),
        reading_channel = ProtoField.uint8(prefix .. ".reading.channel", "Channel"),
        reading_value = ProtoField.double(prefix .. ".reading.value", "Value"),
        reading_unit = ProtoField.string(prefix .. ".reading.unit", "Unit"),
        reading_status = ProtoField.string(prefix .. ".reading.status", "Status"),
    }
    for _, list in ipairs(messages) do
        for _, field in ipairs(list) do
            if field.name and not fields[field.name] and not LISTS[field.kind] then
                local make = MAKERS[field.kind]
                local name = prefix .. "." .. field.name
                if make then
                    fields[field.name] = make(name, title(field.name))
                else
                    local in_hex = IN_HEX[field.name]
                    fields[field.name] = (in_hex or ProtoField.uint32)(name, title(field.name), in_hex and base.HEX)
                end
            end
        end
    end
    return of_group(prefix, fields, EXPERTS)
end

local function list_of(found)
    local made = {}
    for _, one in pairs(found) do
        made[#made + 1] = one
    end
    return made
end

local function add_errata(root, made, errata)
    if not preferences.errata or not errata or #errata == 0 then
        return
    end
    local list = root:add("Errata: " .. table.concat(errata, ", "))
    list:set_generated()
    for _, id in ipairs(errata) do
        local item = list:add(made.fields.erratum, id):set_generated()
        item:append_text(": " .. ERRATA[id].what)
        item:add_proto_expert_info(made.experts.erratum, id .. ": " .. ERRATA[id].reading)
    end
end

local function add_preference_fault(root, made)
    if preferences.fault then
        root:add_proto_expert_info(made.experts.preference, "Preference: " .. preferences.fault)
    end
end

-- Add a field of a message, with what it means.
local function add_field(root, made, field, range, value, values, profile)
    local item = root:add(made.fields[field.name], range, value)
    local words = in_words(field, value, values)
    if words then
        item:append_text(" (" .. words .. ")")
    end
    local meaning = item:add(range, "Meaning: " .. field.meaning)
    if field.minimum and field.maximum then
        meaning:append_text(string.format("; %.10g to %.10g", field.minimum, field.maximum))
    end
    if not is_legal(field, value, values, profile) then
        local of = profile.model and " of the " .. profile.model.name or ""
        item:add_proto_expert_info(made.experts.out_of_range, title(field.name) .. of .. " is out of range")
    end
    return item
end

-- Add the reading of a channel.
local function add_reading(root, made, range, shown, channel, value, unit, status, note)
    local item = root:add(made.fields.reading, range, shown)
    local words = value and string.format("%.10g", value) .. (unit and " " .. unit or "") or title(status)
    item:set_text(string.format("Channel %d: %s (%s)", channel, words, shown))
    item:add(made.fields.reading_channel, range, channel)
    if value then
        item:add(made.fields.reading_value, range, value)
    end
    if unit then
        item:add(made.fields.reading_unit, range, unit)
    end
    item:add(made.fields.reading_status, range, status)
    if note then
        item:add_proto_expert_info(made.experts.no_reading, "Channel " .. channel .. ": " .. note)
    elseif status == "over_range" or status == "under_range" then
        item:add_proto_expert_info(made.experts.range_status, "Channel " .. channel .. ": " .. title(status))
    end
end

-- Which request a response belongs to; found out once, when the packets are read in order.
local function pairing()
    local self = { open = {}, kept = {}, answers = {} }
    function self.clear()
        self.open, self.kept, self.answers = {}, {}, {}
    end
    -- The request for the n-th frame of a packet, or nil.
    function self.request(pinfo, line, n)
        local key = pinfo.number .. " " .. n
        if not pinfo.visited then
            local request = self.open[line]
            self.kept[key] = request and not request.answered and request or nil
        end
        return self.kept[key]
    end
    function self.ask(pinfo, line, request)
        if not pinfo.visited then
            self.open[line] = request
        end
    end
    function self.answer(pinfo, request)
        if not pinfo.visited then
            request.answered = true
            self.answers[request.frame] = pinfo.number
        end
    end
    return self
end

local function add_request(root, made, pinfo, request)
    root:add(made.fields.response_to, request.frame):set_generated()
    root:add(made.fields.time, pinfo.rel_ts - request.time):set_generated()
end

local function add_answer(root, made, pinfo, pairs_of)
    local frame = pairs_of.answers[pinfo.number]
    if frame then
        root:add(made.fields.response_in, frame):set_generated()
    end
end

-- The dissector of DCON.

local dcon = Proto("dcon", "DCON (ICP DAS I-7000)")
local dcon_lists = {}
for _, command in ipairs(DCON_COMMANDS) do
    dcon_lists[#dcon_lists + 1] = command.parts
    dcon_lists[#dcon_lists + 1] = command.response_parts
end
local dcon_made = group("dcon", dcon_lists)
dcon_made.fields.checksum = ProtoField.string("dcon.checksum", "Checksum")
dcon_made.fields.noise = ProtoField.bytes("dcon.noise", "Noise")
dcon_made.fields.data = ProtoField.string("dcon.data", "Data")
dcon.fields = list_of(dcon_made.fields)
dcon.experts = list_of(dcon_made.experts)

local dcon_pairs = pairing()

local learned_of = {}

function dcon.init()
    dcon_pairs.clear()
    learned_of = {}
end

local function learned_key(line, address)
    return line .. "/" .. tostring(address)
end

-- Keep what a response shows of a module: the format of its readings, its types. What a module acknowledges is in the
-- command. A table once kept never changes, so that every packet is read with what was known at its time.
local function learn(line, key, found, request, profile)
    local name, values, before = found.message.name, found.values, learned_of[key] or {}
    if name == "Acknowledged" then
        name, values = request.command.name, request.values
    end
    if name == "Configuration" or name == "SetConfiguration" then
        local one = TYPES[values.type_code] and not (profile.model and profile.model.mixed_types == "ignored")
        learned_of[key] = nil
        learned_of[values.new_address and learned_key(line, values.new_address) or key] = {
            format = FORMATS[bits(values.report_settings, 0, 2)] or before.format,
            types = one and { values.type_code } or before.types,
        }
    elseif (name == "ChannelTypeCode" or name == "SetChannelTypeCode") and TYPES[values.type_code] then
        local types = {}
        for channel = 0, (channels_of(profile) or 20) - 1 do
            local old = type_of({ model = profile.model, types = before.types }, channel)
            types[channel + 1] = channel == values.channel and values.type_code or old and old.code or false
        end
        learned_of[key] = { format = before.format, types = types }
    end
end

local function add_readings(root, field, range_of, place, fields, request, profile)
    local values = request and request.values or {}
    local first = field.kind == "reading" and values.channel or 0
    local at = place[1]
    local format = format_of(table.concat(fields), field, profile)
    local legacy = is_legacy(profile)
    for index, text in ipairs(fields) do
        local channel = first + index - 1
        local kind = type_of(profile, channel)
        local value, unit, status, note = reading_of_text(text, format, kind, legacy)
        add_reading(root, dcon_made, range_of(at, #text), text, channel, value, unit, status, note)
        at = at + #text
    end
end

-- Add a decoded body to the tree.
local function add_message(root, found, range_of, request, profile)
    local row = request and request.command or found.message
    root:add(dcon_made.fields.message, range_of(1, 1), found.message.name)
    root:add(dcon_made.fields.section, row.section):append_text(": " .. row.description):set_generated()
    for _, part in ipairs(found.message.parts) do
        local place = part.name and found.places[part.name]
        local value = part.name and found.values[part.name]
        if place and LISTS[part.kind] then
            add_readings(root, part, range_of, place, value, request, profile)
        elseif place then
            add_field(root, dcon_made, part, range_of(place[1], place[2]), value, found.values, profile)
        end
    end
    if found.message == REFUSED then
        root:add_proto_expert_info(dcon_made.experts.refused, "Refused: " .. row.name)
    end
    if found.other then
        root:add_proto_expert_info(dcon_made.experts.ambiguous, "On other models this is " .. found.other.name)
    end
end

local FAULTS = {
    length = "Too long or too short", terminator = "No CR at the end, or one before it",
    character = "A character that may not stand there", leading = "No frame of this direction begins so",
    checksum = "Wrong checksum", command = "No command", unsupported = "The model does not have the command",
    value = "A value that is not defined", number = "Not a number of this format",
    address = "Not the address of the request", ["function"] = "Not a function of these modules",
    sub_function = "Not a sub-function of these modules", crc = "Wrong CRC", range = "The count is out of range",
    count = "The byte count is not that of the count", reserved = "A reserved byte is not 0",
    echo = "Not what the request has",
}

local function add_fault(root, made, fault, detail)
    root:add(made.fields.fault, fault):set_generated()
    local kind = (fault == "checksum" or fault == "crc") and made.experts.checksum or made.experts.fault
    root:add_proto_expert_info(kind, FAULTS[fault] .. (detail and ": " .. detail or ""))
end

-- A response whose command is not in the capture: readings can be read all the same.
local function add_unpaired(root, body, range_of, profile)
    root:add_proto_expert_info(dcon_made.experts.no_request)
    local values = READINGS_PART
    local fields = body:sub(1, 1) == ">" and width_fits(values, profile, body:sub(2))(#body - 1)
        and read_readings(body:sub(2), values, profile)
    if fields then
        root:add(dcon_made.fields.message, range_of(1, 1), "AnalogInputs"):append_text(" (assumed)")
        add_readings(root, values, range_of, { 2, #body - 1 }, fields, nil, profile)
    elseif body:match("^[!%?][%dA-F][%dA-F]") then
        root:add(dcon_made.fields.address, range_of(2, 2), tonumber(body:sub(2, 3), 16))
        if body:sub(1, 1) == "?" then
            root:add_proto_expert_info(dcon_made.experts.refused)
        elseif #body > 3 then
            root:add(dcon_made.fields.data, range_of(4, #body - 3), body:sub(4))
        end
    end
end

local function add_checksum(root, found, range_of, body)
    if found.checksum then
        root:add(dcon_made.fields.checksum, range_of(#body - 1, 2), found.checksum)
            :append_text(found.checksum == found.right and " (right)" or " (wrong, should be " .. found.right .. ")")
    end
end

-- Dissect a frame that begins at a place of a packet; `n` counts the frames of the packet.
local function dissect_frame(tvb, start, frame, pinfo, tree, n)
    local root = tree:add(dcon, tvb:range(start, #frame))
    local function range_of(at, size)
        return tvb:range(start + at - 1, size)
    end
    local line, interface = line_of(pinfo), interface_of()
    local is_response = frame:match(RESPONSES_BEGIN) ~= nil
    if pinfo.p2p_dir == SENT or pinfo.p2p_dir == RECEIVED then
        is_response = pinfo.p2p_dir == RECEIVED
    end
    local body = frame:gsub("\r$", "")
    local request = is_response and dcon_pairs.request(pinfo, line, n) or nil
    local address = request and request.values.address or tonumber(body:match("^.(%x%x)") or "", 16)
    local learned = learned_key(line, address)
    local given = profile_of(interface, address)
    local profile = with_learned(given, request and request.learned)
    add_preference_fault(root, dcon_made)
    local found = { fault = frame_fault(frame, is_response and RESPONSES_BEGIN or COMMANDS_BEGIN) }
    if not found.fault and is_response and not request then
        local text = body
        local right = #body > 2 and checksum_of(body:sub(1, -3))
        if right and (profile.checksum or profile.checksum == nil and right == body:sub(-2)) then
            found = { checksum = body:sub(-2), right = right }
            text = body:sub(1, -3)
            found.fault = found.checksum ~= found.right and "checksum" or nil
        end
        add_unpaired(root, text, range_of, profile)
    elseif not found.fault then
        local with = profile.checksum
        if with == nil and request then
            with = request.with_checksum
        end
        local function read(known)
            return read_body(body, with, function(text)
                if is_response then
                    return response_of(text, request, known)
                end
                return command_of(text, known)
            end)
        end
        found = read(profile)
        -- What was learned may be out of date, so it is no reason for a fault.
        local fresh = found.fault and profile ~= given and read(given)
        if fresh and not fresh.fault then
            found, profile = fresh, given
            if not pinfo.visited then
                learned_of[learned] = nil
            end
        end
    end
    if found.message then
        add_message(root, found, range_of, request, profile)
    end
    add_checksum(root, found, range_of, body)
    if found.fault then
        add_fault(root, dcon_made, found.fault, found.foreign and found.foreign.name)
    end
    if request then
        add_request(root, dcon_made, pinfo, request)
        if not found.fault then
            dcon_pairs.answer(pinfo, request)
            if not pinfo.visited then
                learn(line, learned, found, request, profile)
            end
        end
    elseif not is_response then
        local command = not found.fault and found.message
        add_errata(root, dcon_made, command and command.errata)
        add_answer(root, dcon_made, pinfo, dcon_pairs)
        dcon_pairs.ask(pinfo, line, command and command.response and {
            command = command, values = found.values, frame = pinfo.number, time = pinfo.rel_ts,
            with_checksum = found.checksum ~= nil, learned = learned_of[learned],
        } or nil)
    end
    local name = found.message and found.message.name or found.fault and FAULTS[found.fault] or "Response"
    local shown = body:gsub("[^ -~]", "."):sub(1, 80)
    root:append_text(", " .. name .. ": " .. shown)
    pinfo.cols.info:append((n > 1 and "; " or "") .. (is_response and "<- " or "-> ") .. name .. "  " .. shown)
end

-- Cut a packet into frames: each the place and the bytes. Of a stream, noise is cut off too, and the rest is kept.
local function frames_of(data, in_stream)
    local found, at = {}, 1
    while at <= #data do
        local stop = data:find("\r", at, true)
        local size = (stop or #data) - at + 1
        found[#found + 1] = { at - 1, data:sub(at, at + size - 1), whole = stop ~= nil }
        at = at + size
    end
    for _, frame in ipairs(found) do
        if not in_stream and not frame[2]:match("^" .. LEADING) then
            return { { 0, data, whole = true } }
        end
    end
    return found
end

function dcon.dissector(tvb, pinfo, tree)
    pinfo.cols.protocol = "DCON"
    pinfo.cols.info = ""
    local data = tvb:raw()
    local in_stream = pinfo.can_desegment > 0
    if tvb:reported_len() > #data then
        local root = tree:add(dcon, tvb:range())
        root:add_proto_expert_info(dcon_made.experts.cut_off)
        return #data
    end
    for n, frame in ipairs(frames_of(data, in_stream)) do
        local start, text = frame[1], frame[2]
        if in_stream and not frame.whole and #text < 256 then
            pinfo.desegment_offset = start
            pinfo.desegment_len = DESEGMENT_ONE_MORE_SEGMENT
            return #data
        end
        local before = in_stream and text:match("^(.*)" .. LEADING .. "[^%%#%$~@!>%?]*$")
        if before and #before > 0 then
            tree:add(dcon_made.fields.noise, tvb:range(start, #before))
            start, text = start + #before, text:sub(#before + 1)
        end
        dissect_frame(tvb, start, text, pinfo, tree, n)
    end
    return #data
end

-- Modbus: PDUs <-> fields, and the maps. A place is that of a byte of the frame, where the address is byte 0.

local function xor(a, b)
    local result, bit = 0, 1
    while a > 0 or b > 0 do
        if a % 2 ~= b % 2 then
            result = result + bit
        end
        a, b, bit = math.floor(a / 2), math.floor(b / 2), bit * 2
    end
    return result
end

local CRC_OF_BYTE = {}
for byte = 0, 255 do
    local crc = byte
    for _ = 1, 8 do
        local odd = crc % 2 == 1
        crc = math.floor(crc / 2)
        if odd then
            crc = xor(crc, 0xA001)
        end
    end
    CRC_OF_BYTE[byte] = crc
end

local function crc_of(data)
    local crc = 0xFFFF
    for at = 1, #data do
        crc = xor(math.floor(crc / 256), CRC_OF_BYTE[xor(crc % 256, data:byte(at))])
    end
    return crc
end

local function number_at(data, at, size)
    local number = 0
    for place = at + 1, at + size do
        number = number * 256 + data:byte(place)
    end
    return number
end

-- How a field's bytes become a value; or nil and a fault.
local CONVERTERS = {
    digits = function(data, at, size)
        return (data:sub(at + 1, at + size):gsub(".", function(character)
            return string.format("%02X", character:byte())
        end))
    end,
    signed = function(data, at, size)
        return signed(number_at(data, at, size))
    end,
    bool = function(data, at)
        local number = data:byte(at + 1)
        if number > 1 then
            return nil, "value"
        end
        return number == 1
    end,
    coil = function(data, at)
        local number = number_at(data, at, 2)
        if number ~= 0 and number ~= 0xFF00 then
            return nil, "value"
        end
        return number ~= 0
    end,
    code = function(data, at, _, field)
        local number = data:byte(at + 1)
        if number < field.minimum or number > field.maximum then
            return nil, "value"
        end
        return number
    end,
}

-- Take a frame apart by the tokens of its PDU: row, values, places (of fields), or nil and a fault. `check` looks at
-- the values that the order of checks has before reserved bytes.
local function take_apart(row, side, data, profile, check)
    local at, places, values, reserved = 1, {}, {}, false
    local numbers = {}
    for token in row[side]:gmatch("%S+") do
        local name, width = token:match("^(%l[%l_]*):?(%w*)$")
        local size = tonumber(width) or 1
        if width == "mask" then
            local channels = channels_of(profile)
            size = channels and math.floor((channels + 7) / 8) or math.min(math.max(#data - at, 1), 3)
        elseif width == "bits" or width == "words" then
            size = numbers.bytes
        end
        if at + size > #data then
            return nil, "length"
        end
        if not name then
            reserved = reserved or token == "00" and at > 2 and data:byte(at + 1) ~= 0
        else
            if width ~= "bits" and width ~= "words" then
                numbers[name] = number_at(data, at, size)
            end
            places[#places + 1] = { name, at, size }
        end
        at = at + size
    end
    if at ~= #data then
        return nil, "length"
    end
    local fault = check(numbers) or reserved and "reserved"
    if fault then
        return nil, fault
    end
    for _, place in ipairs(places) do
        local field = row[side .. "_fields"][place[1]]
        local convert = field and CONVERTERS[field.kind]
        if convert then
            values[place[1]], fault = convert(data, place[2], place[3], field)
            if fault then
                return nil, fault
            end
        else
            values[place[1]] = numbers[place[1]]
        end
    end
    return row, values, places
end

local function bytes_needed(row, count)
    local is_bits = row.request:match(":bits") or row.response:match(":bits")
    return is_bits and math.floor((count + 7) / 8) or 2 * count
end

-- The row of a function, and of 46h of its sub-function; or nil and a fault.
local function row_of(data)
    local code = data:byte(2)
    if code == 0x46 then
        if #data < 3 then
            return nil, "length"
        end
        local row = MODULE_SETTINGS[data:byte(3)]
        return row, not row and "sub_function" or nil
    end
    local row = FUNCTIONS[code]
    return row, not row and "function" or nil
end

-- What a request is, without CRC: its row, values and places; or nil and a fault.
local function request_of(data, profile)
    local row, fault = row_of(data)
    if data:byte(1) > 247 then
        return nil, "address"
    elseif not row then
        return nil, fault
    elseif data:byte(1) == 0 and not row.broadcast then
        return nil, "address"
    end
    return take_apart(row, "request", data, profile, function(numbers)
        local count = numbers.count
        if count and (count < row.minimum_count or count > row.maximum_count or numbers.start + count > 65536) then
            return "range"
        end
        return count and numbers.bytes and numbers.bytes ~= bytes_needed(row, count) and "count" or nil
    end)
end

local EXCEPTION = {
    name = "ExceptionResponse", response = "function exception_code", response_fields = EXCEPTION_FIELDS,
}

-- Whether a response has bits that are reserved: of channels that the module does not have, of settings that no module
-- has, or above the byte that the offset of a channel is.
local function has_reserved_bits(row, numbers, asked, profile)
    local channels = channels_of(profile)
    if numbers.mask then
        return channels ~= nil and numbers.mask >= 2 ^ channels
    elseif numbers.settings then
        return row.response_fields.settings.legal[numbers.settings] == nil
    end
    return numbers.offset and asked and asked.channel and asked.channel >= 0x80 and numbers.offset > 0xFF
end

-- What a response is, without CRC; the request may be unknown.
local function response_to(data, request, profile)
    local code = data:byte(2)
    if data:byte(1) == 0 or request and data:byte(1) ~= request.data:byte(1) then
        return nil, "address"
    elseif request and code % 128 ~= request.data:byte(2) % 128 then
        return nil, "function"
    elseif code >= 0x80 then
        if #data ~= 3 then
            return nil, "length"
        end
        local values = { ["function"] = code - 0x80, exception_code = data:byte(3) }
        return EXCEPTION, values, { { "function", 1, 1 }, { "exception_code", 2, 1 } }
    end
    local row, fault = row_of(data)
    if not row then
        return nil, fault
    elseif request and request.row and row ~= request.row then
        return nil, "sub_function"
    end
    local asked = request and request.row and request.values
    return take_apart(row, "response", data, profile, function(numbers)
        if asked and numbers.bytes and numbers.bytes ~= bytes_needed(row, asked.count) then
            return "count"
        end
        if asked and not numbers.bytes and code ~= 0x46 and data:sub(3) ~= request.data:sub(3, #data) then
            return "echo"
        end
        return has_reserved_bits(row, numbers, asked, profile) and "reserved" or nil
    end)
end

local AREAS = {
    [1] = { "coil", "0" }, [2] = { "discrete_input", "1" }, [3] = { "holding_register", "4" },
    [4] = { "input_register", "3" }, [5] = { "coil", "0" }, [6] = { "holding_register", "4" },
    [15] = { "coil", "0" }, [16] = { "holding_register", "4" },
}
local WRITES = { [5] = true, [6] = true, [15] = true, [16] = true }

local function map_of(profile)
    for _, map in ipairs(MAPS) do
        if profile.model and map.models[profile.model.name] then
            return map
        end
    end
end

-- The row of a map that has an address, or nil.
local function register_at(map, area, address, profile)
    for _, row in ipairs(map.rows) do
        if row.area == area and address >= row.address and address < row.address + row.count
            and (not row.models or row.models[profile.model.name]) and since(profile, row.firmware) then
            return row
        end
    end
end

-- Which channel a register has a reading of, or nil.
local function channel_at(row, address)
    local offset = address - row.address
    if row.type == "reading" then
        return offset
    elseif row.type == "record" and offset % 18 < 16 then
        return offset % 18
    end
end

-- The number of an item, from one or two words; and whether it is the second word of it.
local function number_of(row, address, word, next_word)
    if row.type == "uint32" or row.type == "record" then
        local is_second = (address - row.address) % 2 == 1
        if is_second or not next_word then
            return nil, is_second
        end
        return word + 65536 * next_word
    elseif row.type == "int16" then
        return signed(word)
    elseif row.type == "int8" then
        return word >= 0x80 and word < 0x100 and word - 0x100 or word
    end
    return word
end

local function item_in_words(row, number)
    local named = row.values and row.values[number]
    if named then
        return named
    elseif row.legal == "types" then
        return TYPES[number] and TYPES[number].name or "undefined"
    elseif row.legal == "channel_bits" then
        return channels_in(row.name == "channel_mask_high" and number * 0x10000 or number)
    elseif row.name == "line_settings" then
        return (settings_in(number, "CC", {}))
    elseif row.unit then
        return string.format("%.10g %s", number * (row.scale or 1), row.unit)
    end
end

local function item_is_legal(row, number, profile)
    if row.name == "line_settings" then
        local _, good = settings_in(number, "CC", profile)
        return good
    elseif row.legal == "types" then
        return is_type(number, profile)
    elseif type(row.legal) == "table" then
        return row.legal[number] ~= nil
    end
    return (not row.minimum or number >= row.minimum) and (not row.maximum or number <= row.maximum)
end

-- What these modules mean by Modbus: behind Wireshark's dissectors of Modbus RTU and Modbus/TCP.

local i7000 = Proto("i7000", "ICP DAS M-7000 (Modbus)")
local modbus_lists = { { EXCEPTION_FIELDS["function"], EXCEPTION_FIELDS.exception_code } }
for _, rows in ipairs({ FUNCTIONS, MODULE_SETTINGS }) do
    for _, row in pairs(rows) do
        modbus_lists[#modbus_lists + 1] = list_of(row.request_fields)
        modbus_lists[#modbus_lists + 1] = list_of(row.response_fields)
    end
end
local modbus_made = group("i7000", modbus_lists)
modbus_made.fields.address = ProtoField.uint8("i7000.address", "Address")
modbus_made.fields.value = ProtoField.uint32("i7000.value", "Value")
modbus_made.fields.item = ProtoField.string("i7000.item", "Item")
modbus_made.fields.item_name = ProtoField.string("i7000.item.name", "Name")
modbus_made.fields.item_value = ProtoField.double("i7000.item.value", "Value")
modbus_made.fields.item_unit = ProtoField.string("i7000.item.unit", "Unit")
i7000.fields = list_of(modbus_made.fields)
i7000.experts = list_of(modbus_made.experts)

local rtu_unit, tcp_unit = Field.new("mbrtu.unit_id"), Field.new("mbtcp.unit_id")
local encapsulation_field = Field.new("frame.encap_type")
local tcp_length, tcp_transaction = Field.new("mbtcp.len"), Field.new("mbtcp.trans_id")

local modbus_pairs = pairing()
local hosts = {}

function i7000.init()
    modbus_pairs.clear()
    hosts = {}
end

local function add_register(root, range, area, address, word, next_word, map, profile, is_write)
    local shown = string.format("%s%04d", area[2], address + 1)
    local row = map and register_at(map, area[1], address, profile)
    local item = root:add(modbus_made.fields.item, range, shown)
    if not map then
        item:append_text(string.format(" = %d", word))
        return
    end
    if not row or not row.access:find(is_write and "W" or "R", 1, true) then
        local text = row and row.name .. " is not for this access" or "not in the map of the " .. profile.model.name
        item:add_proto_expert_info(modbus_made.experts.access, shown .. ": " .. text)
    end
    if not row then
        return
    end
    item:append_text(" " .. row.name)
    if row.count > 1 and row.type ~= "uint32" then
        item:append_text(string.format("[%d]", address - row.address))
    end
    item:add(modbus_made.fields.item_name, range, row.name):append_text(": " .. row.meaning)
    local channel = channel_at(row, address)
    if channel then
        local value, unit, status = reading_of_register(word, profile.modbus_format, type_of(profile, channel))
        add_reading(item, modbus_made, range, string.format("%d", word), channel, value, unit, status)
        item:append_text(" = " .. (value and string.format("%.10g %s", value, unit) or word .. " " .. status))
        return
    end
    local number, is_second = number_of(row, address, word, next_word)
    if not number then
        item:append_text(string.format(" = %d (%s word)", word, is_second and "high" or "low"))
        return
    end
    item:add(modbus_made.fields.item_value, range, number * (row.scale or 1))
    if row.unit then
        item:add(modbus_made.fields.item_unit, range, row.unit)
    end
    local words = item_in_words(row, number)
    item:append_text(string.format(" = %.10g", number) .. (words and " (" .. words .. ")" or ""))
    if not item_is_legal(row, number, profile) and (is_write or type(row.legal) == "string") then
        item:add_proto_expert_info(modbus_made.experts.out_of_range, title(row.name) .. " is out of range")
    end
end

-- Add the coils or registers that a frame has.
local function add_registers(root, data, range_of, place, start, count, profile)
    local code = data:byte(2)
    local area, map = AREAS[code], map_of(profile)
    local is_bits = area[1] == "coil" or area[1] == "discrete_input"
    for index = 0, count - 1 do
        local address = start + index
        local at, size, word, next_word
        if code == 5 or code == 6 then
            at, size = place[2], 2
            word = number_at(data, at, 2)
            word = code == 5 and (word == 0 and 0 or 1) or word
        elseif is_bits then
            at, size = place[2] + math.floor(index / 8), 1
            word = bits(data:byte(at + 1), index % 8, 1)
        else
            at, size = place[2] + 2 * index, 2
            word = number_at(data, at, 2)
            next_word = index + 1 < count and number_at(data, at + 2, 2) or nil
        end
        add_register(root, range_of(at, size), area, address, word, next_word, map, profile, WRITES[code])
    end
end

-- Add the first coil or register of a request to read that a module does not have.
local function add_missing(root, data, start, count, profile)
    local area, map = AREAS[data:byte(2)], map_of(profile)
    for address = start, map and start + count - 1 or -1 do
        local row = register_at(map, area[1], address, profile)
        if not row or not row.access:find("R", 1, true) then
            local shown = string.format("%s%04d", area[2], address + 1)
            local text = shown .. ": cannot be read on the " .. profile.model.name
            root:add_proto_expert_info(modbus_made.experts.access, text)
            return
        end
    end
end

local function add_pdu(root, data, row, values, places, side, request, range_of, profile)
    root:add(modbus_made.fields.message, range_of(1, data:byte(2) == 0x46 and 2 or 1), row.name)
    local described = request and request.row or row
    if described.section then
        local section = root:add(modbus_made.fields.section, described.section):set_generated()
        section:append_text(": " .. described.description)
    end
    local context = {}
    for name, value in pairs(request and request.values or {}) do
        context[name] = value
    end
    for name, value in pairs(values) do
        context[name] = value
    end
    for _, place in ipairs(places) do
        local field = row[side .. "_fields"][place[1]]
        local is_item = AREAS[data:byte(2)] and (place[1] == "values" or place[1] == "value")
        local start = context.start or context.coil or context.register
        if is_item and start then
            local count = place[1] == "value" and 1 or context.count
            add_registers(root, data, range_of, place, start, count, profile)
        elseif field and not LISTS[field.kind] then
            local value = values[place[1]]
            local item = add_field(root, modbus_made, field, range_of(place[2], place[3]), value, context, profile)
            if place[1]:match("result$") and value ~= 0 then
                item:add_proto_expert_info(modbus_made.experts.refused, "The module reports an error")
            end
        end
    end
    if side == "request" and not has(row.models, profile) then
        local text = "The " .. profile.model.name .. " does not have " .. row.name
        root:add_proto_expert_info(modbus_made.experts.access, text)
    elseif side == "request" and AREAS[data:byte(2)] and not WRITES[data:byte(2)] then
        add_missing(root, data, values.start, values.count, profile)
    end
    if row == EXCEPTION then
        local why = described.exceptions and described.exceptions[values.exception_code]
        root:add_proto_expert_info(modbus_made.experts.refused, string.format("Refused: %s, exception %d%s",
            described.name or "unknown", values.exception_code, why and ": " .. why or ""))
    end
end

-- Whether a frame, here without CRC, is a response: by the direction of the packet, the port, who spoke first, or what
-- was asked. A host may repeat a request that nobody answered.
local function is_from_module(pinfo, line, body, request, profile)
    if pinfo.p2p_dir == SENT or pinfo.p2p_dir == RECEIVED then
        return pinfo.p2p_dir == RECEIVED
    elseif pinfo.src_port ~= 0 then
        local port = 502
        if pinfo.src_port == port or pinfo.dst_port == port then
            return pinfo.src_port == port
        end
        local sender = tostring(pinfo.src) .. " " .. pinfo.src_port
        hosts[line] = hosts[line] or sender
        return hosts[line] ~= sender
    end
    if not request or body:byte(1) ~= request.data:byte(1) or body:byte(2) % 128 ~= request.data:byte(2) then
        return false
    end
    return response_to(body, request, profile) ~= nil or request_of(body, profile) == nil
end

local function dissect_adu(tvb, start, data, transaction, pinfo, tree, n)
    local root = tree:add(i7000, tvb:range(start, #data))
    local function range_of(at, size)
        return tvb:range(start + at, size)
    end
    add_preference_fault(root, modbus_made)
    local line = line_of(pinfo)
    local key = line .. (transaction and " " .. transaction or "")
    local request = modbus_pairs.request(pinfo, key, n)
    local body = transaction and data or data:sub(1, -3)
    local profile = profile_of(interface_of(), #data > 0 and data:byte(1) or nil)
    local from_module = #body >= 2 and is_from_module(pinfo, line, body, request, profile)
    request = from_module and request or nil
    local fault
    if #data < (transaction and 2 or from_module and 5 or 4) or #data > 256 + (transaction and 4 or 0) then
        fault = "length"
    elseif not transaction and crc_of(data) ~= 0 then
        fault = "crc"
    end
    local row, values, places
    if not fault then
        if from_module then
            row, values, places = response_to(body, request, profile)
        else
            row, values, places = request_of(body, profile)
        end
        fault = not row and values or nil
    end
    local side = from_module and "response" or "request"
    local name = fault and FAULTS[fault] or from_module and row.response_name or row.name
    if row then
        root:add(modbus_made.fields.address, range_of(0, 1), body:byte(1))
        local shown = setmetatable({ name = name }, { __index = row })
        add_pdu(root, body, row == EXCEPTION and row or shown, values, places, side, request, range_of, profile)
    else
        add_fault(root, modbus_made, fault)
    end
    if request then
        add_request(root, modbus_made, pinfo, request)
        if row then
            modbus_pairs.answer(pinfo, request)
        end
    elseif from_module then
        root:add_proto_expert_info(modbus_made.experts.no_request)
    else
        add_errata(root, modbus_made, row and row.errata)
        add_answer(root, modbus_made, pinfo, modbus_pairs)
        modbus_pairs.ask(pinfo, key, (row or fault ~= "crc" and #body >= 2) and {
            row = row, values = row and values or {}, data = body, frame = pinfo.number, time = pinfo.rel_ts,
        } or nil)
    end
    root:append_text(", " .. name)
    local shown = (from_module and "<- " or "-> ") .. name .. (#body > 0 and ", address " .. body:byte(1) or "")
    if n == 1 and (#body < 2 or not transaction or body:byte(2) % 0x80 == 0x46) then
        pinfo.cols.info = shown
    else
        pinfo.cols.info:append(" | " .. shown)
    end
end

-- The frames of a packet, as Wireshark found them: the bytes, where they are, and the transaction of Modbus/TCP.
local function adus()
    local found = {}
    local units = { rtu_unit() }
    for index, unit in ipairs(units) do
        local after = units[index + 1]
        local stop = unit.source:len()
        if after and after.offset > unit.offset then
            stop = after.offset
        end
        found[#found + 1] = { unit.source, unit.offset, stop }
    end
    local lengths, transactions = { tcp_length() }, { tcp_transaction() }
    for index, unit in ipairs({ tcp_unit() }) do
        local length, transaction = lengths[index], transactions[index]
        if length and transaction then
            local stop = math.min(unit.offset + length.value, unit.source:len())
            found[#found + 1] = { unit.source, unit.offset, stop, transaction.value }
        end
    end
    return found
end

local function add_cut_off(tree, range)
    tree:add(i7000, range):add_proto_expert_info(modbus_made.experts.cut_off)
end

-- Whether a frame on a network is for these modules: of function 46h, or of any if the model is known.
local function is_ours(data)
    return profile_of(interface_of(), data:byte(1)).model or (data:byte(2) or 0) % 0x80 == 0x46
end

-- Every packet of a serial line is a frame, also those that Wireshark does not take for Modbus.
function i7000.dissector(tvb, pinfo, tree)
    local encapsulation = encapsulation_field()
    if i7000.prefs.rtu_link_type and encapsulation and encapsulation.value == wtap.USER0 and tvb:len() > 0 then
        pinfo.cols.protocol = "Modbus RTU"
        if tvb:reported_len() > tvb:len() then
            add_cut_off(tree, tvb:range())
        else
            dissect_adu(tvb, 0, tvb:raw(), nil, pinfo, tree, 1)
        end
        return
    end
    for n, adu in ipairs(adus()) do
        local source, start, stop, transaction = adu[1], adu[2], adu[3], adu[4]
        local data = stop > start and source:raw(start, stop - start)
        if data and is_ours(data) then
            if source:reported_len() > source:len() then
                add_cut_off(tree, source:range(start))
            else
                dissect_adu(source, start, data, transaction, pinfo, tree, n)
            end
        end
    end
end

-- Preferences, and where the dissectors are called.

local MODEL_CHOICES = { { 1, "unknown", 0 } }
for index, model in ipairs(MODELS) do
    MODEL_CHOICES[#MODEL_CHOICES + 1] = { index + 1, model.name, index }
end
local FORMAT_CHOICES = { { 1, "automatic", 0 }, { 2, "engineering", 1 }, { 3, "percent", 2 }, { 4, "hex", 3 } }
local MODBUS_FORMAT_CHOICES = { { 1, "engineering", 0 }, { 2, "hex", 2 } }
local CHECKSUM_CHOICES = { { 1, "automatic", 0 }, { 2, "disabled", 1 }, { 3, "enabled", 2 } }

i7000.prefs.model = Pref.enum("Model", 0, "The model of the modules; register names and types depend on it",
    MODEL_CHOICES)
i7000.prefs.firmware = Pref.string("Firmware", "", "The firmware of the modules, such as B3.7; empty: the newest")
i7000.prefs.types = Pref.string("Types", "",
    "The type of all channels, such as K, V_10, MA_4_20 or 0F, or one for each with / between; "
    .. "empty: what $AA2 and $AA8Ci returned, or the factory default")
i7000.prefs.format = Pref.enum("DCON format", 0,
    "The format of DCON readings; automatic: what $AA2 returned, or what they look like", FORMAT_CHOICES)
i7000.prefs.modbus_format = Pref.enum("Modbus format", 2, "The format of analog registers, coil 00269",
    MODBUS_FORMAT_CHOICES)
i7000.prefs.checksum = Pref.enum("DCON checksum", 0, "Whether DCON frames have a checksum", CHECKSUM_CHOICES)
i7000.prefs.single_ended = Pref.bool("Single-ended", false, "The inputs of a 7017Z are single-ended")
i7000.prefs.modules = Pref.string("Modules", "",
    "Modules that differ, with blanks between: 1=M-7019R@B3.7,type=K,checksum=true 2=I-7018,format=hex; "
    .. "before the address, the number of an interface and a colon may stand")
i7000.prefs.errata = Pref.bool("Errata", true, "Show where the manual is contradictory or silent")
i7000.prefs.rtu_link_type = Pref.bool("Modbus RTU on link type 147", true,
    "Captures of link type 147 (USER0) are Modbus RTU, as i7000 writes them")

dcon.prefs.tcp_port = Pref.uint("TCP port", 0, "The TCP port of a serial device server; 0: none")
dcon.prefs.link_type = Pref.bool("DCON on link type 148", true,
    "Captures of link type 148 (USER1) are DCON, as i7000 writes them")

local encapsulations, tcp_ports = DissectorTable.get("wtap_encap"), DissectorTable.get("tcp.port")
local before = {}

-- Take a link type, or give it back to whom it belonged to.
local function take(encapsulation, dissector, wanted)
    before[encapsulation] = before[encapsulation] or encapsulations:get_dissector(encapsulation)
    if wanted then
        encapsulations:add(encapsulation, dissector)
    elseif before[encapsulation] then
        encapsulations:add(encapsulation, before[encapsulation])
    end
end

local function take_rtu()
    take(wtap.USER0, Dissector.get("mbrtu"), i7000.prefs.rtu_link_type)
end

function i7000.prefs_changed()
    read_preferences(i7000.prefs)
    take_rtu()
end

local function take_dcon()
    take(wtap.USER1, dcon, dcon.prefs.link_type)
end

local port_before = 0

function dcon.prefs_changed()
    take_dcon()
    if dcon.prefs.tcp_port ~= port_before then
        if port_before ~= 0 then
            tcp_ports:remove(port_before, dcon)
        end
        if dcon.prefs.tcp_port ~= 0 then
            tcp_ports:add(dcon.prefs.tcp_port, dcon)
        end
        port_before = dcon.prefs.tcp_port
    end
end

tcp_ports:add_for_decode_as(dcon)
DissectorTable.get("udp.port"):add_for_decode_as(dcon)
take_dcon()
read_preferences(i7000.prefs)
take_rtu()
register_postdissector(i7000)
