"""Checks docker-compose.yml: docker-compose accepts it and every published port is bound to 127.0.0.1.

Usage: check_compose.py docker-compose.yml
"""

import subprocess
import sys

import yaml


def host_of(port):
    """The address a port is published on; empty when it is published on all of them."""
    if isinstance(port, dict):  # as docker-compose 2 writes it
        return port.get("host_ip", "")
    parts = str(port).split(":")  # as docker-compose 1 does: HOST:PUBLISHED:TARGET
    return parts[0] if len(parts) == 3 else ""


def main():
    command = ["docker-compose", "-f", sys.argv[1], "config"]
    services = yaml.safe_load(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)["services"]
    faults = []
    for name in ("postgis", "postgis-legacy"):
        service = services.get(name, {})
        if not service.get("ports"):
            faults.append(f"service {name} publishes no port")
        if not service.get("healthcheck", {}).get("test"):
            faults.append(f"service {name} has no health check")
    for name, service in services.items():
        if service.get("network_mode") == "host":
            faults.append(f"service {name} is on the host's network")
        for port in service.get("ports", []):
            if host_of(port) != "127.0.0.1":
                faults.append(f"service {name} publishes {port} on more than 127.0.0.1")
    sys.exit("\n".join(faults) if faults else 0)


main()
