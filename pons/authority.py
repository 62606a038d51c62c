"""Keep a certificate authority of this robot's own, and the planner's certificate signed by it.

Owns ``$PONS_HOME/tls``: ``ca.key`` signs, ``ca.crt`` is what devices trust, ``planner.pem`` holds
the planner's certificate with its key in one file, so that both are of one making. Told the time.
"""

from __future__ import annotations

import ipaddress
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING

from cryptography import x509
from cryptography.exceptions import InvalidSignature
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from pons.private_file import own_folder, read, write
from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Iterable

FOLDER = "tls"
AUTHORITY_LIFE = timedelta(days=3_650)
CERTIFICATE_LIFE = timedelta(days=397)
"""Phones refuse longer ones, of private authorities too (Apple: over 825 days)."""
RENEW_BEFORE = timedelta(days=30)
CLOCKS_DIFFER_BY = timedelta(days=1)
"""Certificates begin so long before they are made, for devices whose clocks are behind."""

LOCAL_DOMAINS = ("localhost", "local", "lan", "home.arpa", "internal")
LOCAL_NETWORKS = tuple(
    ipaddress.ip_network(text)
    for text in (
        "127.0.0.0/8", "10.0.0.0/8", "172.16.0.0/12", "192.168.0.0/16", "169.254.0.0/16",
        "100.64.0.0/10", "::1/128", "fc00::/7", "fe80::/10",
    )
)  # fmt: skip
"""A stolen ca.key can sign for these and for the machine's own name, and for no bank."""

Name = x509.DNSName | x509.IPAddress


@dataclass(frozen=True, slots=True)
class IssuedCertificate:
    """Hold the planner's certificate and the authority that a device must trust."""

    authority: Path
    planner: Path
    fingerprint: str
    """SHA-256 of the authority's certificate, as devices show it."""
    names: tuple[str, ...]
    ends: datetime
    made: tuple[str, ...]
    """The files that were made or renewed now."""

    def trust_lines(self) -> tuple[str, ...]:
        """Return a person's instructions to trust this robot."""
        made = f"{', '.join(self.made)} made now; " if self.made else ""
        return (
            f"certificate for {', '.join(self.names)} ({made}it ends {self.ends:%Y-%m-%d})",
            f"devices trust {self.authority}, also the page's /ca.crt, if its SHA-256 is:",
            f"  {self.fingerprint}",
        )

    def planner_arguments(self) -> list[str]:
        """Return the planner process's arguments for it."""
        pair = ["--tls-cert", str(self.planner), "--tls-key", str(self.planner)]
        return [*pair, "--tls-ca", str(self.authority)]

    def planner_environment(self, allowed: Iterable[str]) -> dict[str, str]:
        """Let the planner be asked by each name of its certificate, beside those allowed anyway.

        The check keeps off a foreign name that points here; over TLS that name would have no
        certificate, and these are the robot's own.
        """
        return {"PONS_ALLOWED_HOSTS": ",".join(sorted({*self.names, *allowed}))}


def issue(
    home: Path, machine: str, asked: Iterable[str], found: Iterable[str], now: datetime
) -> IssuedCertificate:
    """Return the planner's certificate for these hosts, made or renewed where it must be.

    ``machine`` is the machine's own name: an authority that is made now may sign for it and for
    each host that was asked for. Of the hosts that were found, it takes those that it may sign for.

    Raises:
        ConfigError: files that others could have read or changed, a damaged or lost authority,
            a name that it may not sign for, or a clock before its beginning.
    """
    folder = home / FOLDER
    own_folder(folder)
    must = {_name(host) for host in asked}
    made: list[str] = []
    key_file, authority_file = folder / "ca.key", folder / "ca.crt"
    authority = _read_certificate(authority_file)
    if authority is None or authority.not_valid_after_utc - now < RENEW_BEFORE:
        authority = _make_authority(key_file, authority_file, machine, must, now)
        made.append(authority_file.name)
    if not authority.not_valid_before_utc <= now:
        detail = f"it is {now:%Y-%m-%d} here, and {authority_file} begins later; set the clock"
        raise ConfigError("clock_before_authority", detail)
    names = _permitted_names(authority, must, {_name(host) for host in found})
    planner_file = folder / "planner.pem"
    certificate = _read_certificate(planner_file)
    if certificate is None or not _serves(certificate, authority, names, now):
        certificate = _sign(key_file, authority, planner_file, names, now)
        made.append(planner_file.name)
    print_of_it = authority.fingerprint(hashes.SHA256()).hex(":").upper()
    shown = tuple(_text(name) for name in names)
    ends = certificate.not_valid_after_utc
    return IssuedCertificate(authority_file, planner_file, print_of_it, shown, ends, tuple(made))


def _serves(
    certificate: x509.Certificate, authority: x509.Certificate, names: list[Name], now: datetime
) -> bool:
    """Return whether a certificate names exactly these, is signed by this one, and lasts."""
    try:
        certificate.verify_directly_issued_by(authority)
    except (InvalidSignature, ValueError, TypeError):
        return False
    named = certificate.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    lasts = certificate.not_valid_after_utc - now >= RENEW_BEFORE
    return set(named) == set(names) and certificate.not_valid_before_utc <= now and lasts


# Making -----------------------------------------------------------------------------------------


def _make_authority(
    key_file: Path, file: Path, machine: str, names: set[Name], now: datetime
) -> x509.Certificate:
    key = ec.generate_private_key(ec.SECP256R1())
    subject = _subject(f"Pons authority of {machine}, {now:%Y-%m-%d}")
    domains = dict.fromkeys((*LOCAL_DOMAINS, machine))
    permitted: list[x509.GeneralName] = [x509.DNSName(domain) for domain in domains]
    permitted += [x509.IPAddress(network) for network in LOCAL_NETWORKS]
    permitted += [_subtree(name) for name in names if not _is_permitted(name, permitted)]
    made = (
        _builder(subject, subject, key.public_key(), now, now + AUTHORITY_LIFE)
        .add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
        .add_extension(_key_usage(signs_certificates=True), critical=True)
        .add_extension(x509.NameConstraints(permitted, None), critical=True)
        .sign(key, hashes.SHA256())
    )
    write(key_file, _private(key))  # first: without its key a certificate is of no use
    write(file, made.public_bytes(serialization.Encoding.PEM), mode=0o644)
    return made


def _sign(
    key_file: Path, authority: x509.Certificate, file: Path, names: list[Name], now: datetime
) -> x509.Certificate:
    signer = _read_key(key_file, authority)
    key = ec.generate_private_key(ec.SECP256R1())
    ends = min(now + CERTIFICATE_LIFE, authority.not_valid_after_utc)
    known = authority.extensions.get_extension_for_class(x509.SubjectKeyIdentifier).value
    made = (
        _builder(_subject("Pons planner"), authority.subject, key.public_key(), now, ends)
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
        .add_extension(_key_usage(signs_certificates=False), critical=True)
        .add_extension(x509.ExtendedKeyUsage([ExtendedKeyUsageOID.SERVER_AUTH]), critical=False)
        .add_extension(x509.SubjectAlternativeName(names), critical=False)
        .add_extension(
            x509.AuthorityKeyIdentifier.from_issuer_subject_key_identifier(known), critical=False
        )
        .sign(signer, hashes.SHA256())
    )
    write(file, made.public_bytes(serialization.Encoding.PEM) + _private(key))
    return made


def _builder(
    subject: x509.Name,
    issuer: x509.Name,
    key: ec.EllipticCurvePublicKey,
    now: datetime,
    ends: datetime,
) -> x509.CertificateBuilder:
    return (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(issuer)
        .public_key(key)
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - CLOCKS_DIFFER_BY)
        .not_valid_after(ends)
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(key), critical=False)
    )


def _subject(common: str) -> x509.Name:
    """Return a subject; devices list an authority by its common name, of at most 64 characters."""
    return x509.Name(
        [
            x509.NameAttribute(NameOID.ORGANIZATION_NAME, "Pons"),
            x509.NameAttribute(NameOID.COMMON_NAME, common[:64]),
        ]
    )


def _key_usage(*, signs_certificates: bool) -> x509.KeyUsage:
    return x509.KeyUsage(
        digital_signature=not signs_certificates,
        key_cert_sign=signs_certificates,
        crl_sign=signs_certificates,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        encipher_only=False,
        decipher_only=False,
    )


# Names ------------------------------------------------------------------------------------------


def _name(host: str) -> Name:
    try:
        return x509.IPAddress(ipaddress.ip_address(host))
    except ValueError:
        pass
    try:
        return x509.DNSName(host.lower())
    except ValueError:
        detail = f"{host!r} is no name for a certificate; expected ASCII, as in xn--…"
        raise ConfigError("tls_bad_name", detail) from None


def _text(name: Name) -> str:
    return str(name.value)


def _subtree(name: Name) -> x509.GeneralName:
    """Return the constraint that permits one name: an address as the network of itself alone."""
    if isinstance(name, x509.DNSName):
        return name
    return x509.IPAddress(ipaddress.ip_network(str(name.value)))


def _is_permitted(name: Name, permitted: Iterable[x509.GeneralName]) -> bool:
    """Return whether an authority with these constraints may sign for a name (RFC 5280)."""
    for subtree in permitted:
        if isinstance(name, x509.DNSName) and isinstance(subtree, x509.DNSName):
            if f".{name.value}".endswith(f".{subtree.value}"):
                return True
        elif isinstance(name, x509.IPAddress) and isinstance(subtree, x509.IPAddress):
            network = ipaddress.ip_network(str(subtree.value))
            if ipaddress.ip_address(str(name.value)) in network:
                return True
    return False


def _permitted_names(authority: x509.Certificate, must: set[Name], may: set[Name]) -> list[Name]:
    constraints = authority.extensions.get_extension_for_class(x509.NameConstraints).value
    subtrees = constraints.permitted_subtrees or []
    for name in sorted(must, key=_text):
        if not _is_permitted(name, subtrees):
            known = ", ".join(str(subtree.value) for subtree in subtrees)
            detail = (
                f"the authority may not sign for {_text(name)}; it may for {known}. Give a "
                "certificate with --tls-cert, or move the folder tls away: every device must then "
                "trust anew"
            )
            raise ConfigError("tls_name_outside", detail)
    return sorted(must | {name for name in may if _is_permitted(name, subtrees)}, key=_text)


# Files ------------------------------------------------------------------------------------------


def _read_certificate(file: Path) -> x509.Certificate | None:
    data = read(file)
    if data is None:
        return None
    try:
        return x509.load_pem_x509_certificate(data)
    except ValueError:
        detail = f"{file} holds no certificate; move it away, and a new one is made"
        raise ConfigError("tls_malformed", detail) from None


def _read_key(file: Path, authority: x509.Certificate) -> ec.EllipticCurvePrivateKey:
    data = read(file)
    if data is None:
        detail = f"{file} is gone, so nothing can be signed; bring it back, or move tls away"
        raise ConfigError("authority_key_missing", detail)
    try:
        key = serialization.load_pem_private_key(data, None)
    except (TypeError, ValueError):
        key = None
    if (
        not isinstance(key, ec.EllipticCurvePrivateKey)
        or key.public_key() != authority.public_key()
    ):
        detail = f"{file} is not the key of ca.crt; bring the right one back, or move tls away"
        raise ConfigError("authority_key_wrong", detail)
    return key


def _private(key: ec.EllipticCurvePrivateKey) -> bytes:
    return key.private_bytes(
        serialization.Encoding.PEM,
        serialization.PrivateFormat.PKCS8,
        serialization.NoEncryption(),
    )
