"""What students hand in, read from their files: measured points, drawings of CAD and geometry programs, scans."""
