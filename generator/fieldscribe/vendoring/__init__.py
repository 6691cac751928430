"""What leaves the repository: a device, or some points of it, as exactly the files that a project needs."""
