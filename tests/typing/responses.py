"""What a type checker knows: type-checked, never run."""

from typing import assert_type

from i7000 import Profile, Reading, dcon


def check(profile: Profile) -> None:
    assert_type(
        dcon.decode_response(b"", dcon.ReadConfiguration(0x01), profile),
        dcon.Configuration | dcon.Refused,
    )
    assert_type(
        dcon.decode_response(b"", dcon.SetChannelMask(0x01, 0xFF), profile),
        dcon.Acknowledged | dcon.Refused,
    )
    assert_type(dcon.readings(dcon.AnalogInputs(("+00.000",)), profile), tuple[Reading, ...])
    assert_type(dcon.ReadProtocol(0x01).response, type[dcon.Response])

    dcon.decode_response(b"", dcon.HostOk(), profile)  # type: ignore[arg-type] # a broadcast has no response
    dcon.SetCjcEnabled(0x01, True)  # type: ignore[call-arg] # a boolean says its name
    dcon.ReadConfiguration(0x01).address = 2  # type: ignore[misc] # frozen
