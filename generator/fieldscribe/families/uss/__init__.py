"""The USS family: telegrams with a parameter part (PKW) and process data (PZD)."""
